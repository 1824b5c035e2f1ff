#pragma once
// Boxes over runs of chords in ring order: neighbours along a ring are neighbours in the plane, so that chords which come
// near each other, and those that a ray meets, are found without asking all of them.

#include <vector>

#include "kernel/heal/draft.h"

namespace trimloop::heal {

struct Chord {
  std::uint32_t piece = 0, sample = 0;  // from this sample of the ring to the next
  Uv a, b;
};

class RunTree {
 public:
  explicit RunTree(std::vector<Chord> chords) : chords_(std::move(chords)) {
    while (leaves_ < chords_.size()) leaves_ *= 2;
    boxes_.resize(2 * leaves_);
    for (std::size_t i = 0; i < chords_.size(); ++i) boxes_[leaves_ + i].add(chords_[i].a), boxes_[leaves_ + i].add(chords_[i].b);
    for (std::size_t i = leaves_; i-- > 1;)
      for (const std::size_t child : {2 * i, 2 * i + 1})
        if (boxes_[child].lo.u <= boxes_[child].hi.u) boxes_[i].add(boxes_[child].lo), boxes_[i].add(boxes_[child].hi);
  }

  const std::vector<Chord>& chords() const { return chords_; }
  const UvBox& box() const { return boxes_[1]; }

  // visit(i, j), i < j, for chords whose boxes meet, until it says false; false then, and when `most` tests were made.
  template <class Visit>
  bool pairs(std::size_t most, std::size_t& tests, const Visit& visit) const {
    std::vector<std::pair<std::size_t, std::size_t>> todo{{1, 1}};
    while (!todo.empty()) {
      const auto [a, b] = todo.back();
      todo.pop_back();
      if (++tests > most) return false;
      if (a != b && !overlap(boxes_[a], boxes_[b])) continue;
      if (a >= leaves_) {
        if (a != b && !visit(a - leaves_, b - leaves_)) return false;
        continue;
      }
      todo.push_back({2 * a, 2 * b});
      todo.push_back({2 * a, 2 * b + 1});
      todo.push_back({2 * a + 1, 2 * b + 1});
      if (a != b) todo.push_back({2 * a + 1, 2 * b});
    }
    return true;
  }

  // Whether a ray from p towards larger u meets an odd number of the chords, which form one closed polygon: p is inside.
  bool is_inside(Uv p) const {
    bool inside = false;
    std::size_t todo[130], count = 0;
    todo[count++] = 1;
    while (count > 0) {
      const std::size_t i = todo[--count];
      const UvBox& box = boxes_[i];
      if (!(box.lo.v <= p.v && p.v <= box.hi.v && p.u <= box.hi.u)) continue;
      if (i >= leaves_) {
        const Uv a = chords_[i - leaves_].a, b = chords_[i - leaves_].b;
        if ((a.v > p.v) == (b.v > p.v)) continue;
        const double side = (b.u - a.u) * (p.v - a.v) - (b.v - a.v) * (p.u - a.u);
        if ((side > 0) == (b.v > a.v)) inside = !inside;
      } else if (p.u < box.lo.u) {  // all of the run is beyond: its ends tell how often it goes over the ray
        inside = inside != ((first_of(i).a.v > p.v) != (last_of(i).b.v > p.v));
      } else {
        todo[count++] = 2 * i;
        todo[count++] = 2 * i + 1;
      }
    }
    return inside;
  }

 private:
  const Chord& first_of(std::size_t i) const {
    while (i < leaves_) i *= 2;
    return chords_[i - leaves_];
  }
  const Chord& last_of(std::size_t i) const {
    while (i < leaves_) i = 2 * i + 1;
    return chords_[std::min(i - leaves_, chords_.size() - 1)];
  }

  std::vector<Chord> chords_;
  std::size_t leaves_ = 1;
  std::vector<UvBox> boxes_;  // of the chords at `leaves_` and on; above them of both children
};

// The ring as one closed polygon: its samples, and what lies between the end of a piece and the start of the next.
RunTree polygon_of(const Ring&);

}  // namespace trimloop::heal
