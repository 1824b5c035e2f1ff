#pragma once
// What runs along each constrained edge: which input constraints, in which direction. A hash table from vertex pairs to
// lists, which keeps its memory from one triangulation to the next.

#include <cstdint>
#include <utility>
#include <vector>

namespace trimloop::mesh {

class EdgeTable {
 public:
  static constexpr std::uint32_t none = 0xffffffffu;

  struct Use {
    std::uint32_t constraint;
    std::int32_t times;  // it runs from the smaller vertex to the larger one, less how often back
    std::uint8_t moved;  // how often rounding has moved it
    std::uint32_t next;  // use of the same edge, or none
  };
  struct Entry {
    std::uint32_t a, b;    // a < b
    std::int32_t winding;  // sum over the uses
    std::uint32_t first;   // use
  };

  // Empties the table and makes room for so many edges.
  void reset(std::size_t edges);
  // The constraint runs a -> b so many times; negative: b -> a.
  void add(std::uint32_t a, std::uint32_t b, std::uint32_t constraint, std::int32_t times, std::uint8_t moved);
  // How often constraints run a -> b, less how often they run b -> a.
  std::int32_t winding(std::uint32_t a, std::uint32_t b) const;
  // First use of an edge; its direction is min -> max. `none` when nothing runs there.
  std::uint32_t first_use(std::uint32_t a, std::uint32_t b) const;
  const Use& use(std::uint32_t index) const { return uses_[index]; }
  // Takes everything off an edge and returns it: one use for each constraint, of which `times` may be 0. Valid until
  // the next call.
  const std::vector<Use>& release(std::uint32_t a, std::uint32_t b);
  // Edge a-b has become a-w and w-b.
  void split(std::uint32_t a, std::uint32_t w, std::uint32_t b);

  const std::vector<Entry>& entries() const { return entries_; }  // some may have no use any more

 private:
  std::size_t slot_of(std::uint32_t a, std::uint32_t b) const;
  void grow();

  std::vector<std::uint32_t> slots_;  // entry or none; open addressing in the first mask_ + 1 of them
  std::size_t mask_ = 0;
  std::vector<Entry> entries_;
  std::vector<Use> uses_, released_;
};

}  // namespace trimloop::mesh
