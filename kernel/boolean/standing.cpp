#include "kernel/boolean/standing.h"

#include <numeric>

namespace trimloop::boolean {
namespace {

class Classifier {
 public:
  Classifier(const Prepared& given, std::size_t k)
      : given_(given), mine_(*given.operands[k]), other_(*given.operands[1 - k]), k_(k) {}

  Result<std::vector<std::vector<Standing>>> run(const SideOf& side, const SideOfPiece& from_border) {
    number();
    connect();
    std::vector<std::optional<Standing>> known(count_);
    for (std::uint32_t f = 0; from_border && f < faces().size(); ++f)
      for (std::uint32_t p = 0; p < faces()[f].pieces.size(); ++p)
        if (const auto s = from_border(f, p)) known[root(first_[f] + p)] = standing_of(*s);
    std::vector<std::vector<Standing>> out;
    for (std::uint32_t f = 0; f < faces().size(); ++f) {
      out.emplace_back();
      for (std::uint32_t p = 0; p < faces()[f].pieces.size(); ++p) {
        if (const auto on = on_other(f, faces()[f].pieces[p])) {
          out.back().push_back(*on);
          continue;
        }
        std::optional<Standing>& standing = known[root(first_[f] + p)];
        for (const Uv uv : faces()[f].pieces[p].inner) {
          if (standing) break;
          if (const auto s = side(evaluate(*mine_.faces()[f].surface, uv)))
            standing = standing_of(*s);
        }
        if (!standing) return fail(ErrorCode::Degenerate, "whether a piece of a face lies inside the other body is not decided");
        out.back().push_back(*standing);
      }
    }
    return out;
  }

 private:
  static Standing standing_of(Side s) { return s == Side::Inside ? Standing::Inside : Standing::Outside; }
  const std::vector<FacePieces>& faces() const { return given_.faces[k_]; }

  void number() {
    for (const FacePieces& f : faces()) {
      first_.push_back(count_);
      count_ += f.pieces.size();
    }
    group_.resize(count_);
    std::iota(group_.begin(), group_.end(), std::size_t{0});
  }
  std::size_t root(std::size_t i) {
    while (group_[i] != i) i = group_[i] = group_[group_[i]];
    return i;
  }
  void connect() {
    std::vector<std::size_t> seen(given_.network.segments.size(), count_);
    for (std::size_t f = 0; f < faces().size(); ++f)
      for (std::size_t p = 0; p < faces()[f].pieces.size(); ++p)
        for (const std::uint32_t cycle : faces()[f].pieces[p].cycles) {
          std::uint32_t i = cycle;
          do {
            const HalfEdge& h = faces()[f].half_edges[i];
            if (h.use.segment != none && !given_.network.segments[h.use.segment].meets) {
              std::size_t& with = seen[h.use.segment];
              if (with == count_) with = first_[f] + p;
              else group_[root(first_[f] + p)] = root(with);
            }
            i = h.next;
          } while (i != cycle);
        }
  }

  std::optional<Standing> on_other(std::uint32_t f, const FacePieces::Piece& piece) const {
    for (const std::uint32_t g : given_.network.faces[k_][f].coincident) {
      const FaceOf &mine = mine_.faces()[f], &theirs = other_.faces()[g];
      for (const Uv uv : piece.inner) {
        const Place place = other_.locate(theirs, evaluate(*mine.surface, uv));
        if (place.where == Where::Border) continue;
        if (place.where == Where::Outside) break;
        const double along = dot(normal(*mine.surface, uv), normal(*theirs.surface, place.uv));
        return (along > 0) == (mine.reversed == theirs.reversed) ? Standing::Same : Standing::Opposed;
      }
    }
    return std::nullopt;
  }

  const Prepared& given_;
  const Operand &mine_, &other_;
  const std::size_t k_;
  std::vector<std::size_t> first_, group_;
  std::size_t count_ = 0;
};

}  // namespace

Result<std::vector<std::vector<Standing>>> standings(const Prepared& given, std::size_t k, const SideOf& side,
                                                     const SideOfPiece& from_border) {
  return Classifier(given, k).run(side, from_border);
}

}  // namespace trimloop::boolean
