#include "kernel/check/compare_drafting.h"

#include <algorithm>

namespace trimloop {
namespace {

struct Side {
  std::vector<std::vector<Point>> strokes;
  std::vector<TextRun> texts;

  void add(const Annotation& a, const Transform& at) {
    for (const auto& points : a.strokes) {
      if (points.empty()) continue;
      auto& placed = strokes.emplace_back();
      for (const Point& p : points) placed.push_back(apply(at, p));
      if (!is_finite(placed.front())) strokes.pop_back();  // a placement that overflows; nothing to compare
    }
    for (TextRun run : a.texts) {
      run.origin = apply(at, run.origin);
      run.along = apply(at, run.along);
      run.up = apply(at, run.up);
      if (is_finite(run.origin)) texts.push_back(std::move(run));
    }
  }
};

Result<Side> placed(const Model& model, std::size_t max_instances, std::size_t max_depth) {
  const auto all = occurrences(model, max_instances, max_depth);
  if (!all) return tl::unexpected<Error>(all.error());
  Side out;
  for (const Occurrence& o : *all)
    for (const Annotation& a : model.parts[o.part].annotation) out.add(a, o.transform);
  for (const Drawing& d : model.drawings)
    for (const Annotation& a : d.annotation) out.add(a, {});
  return out;
}

double begins_at(const std::vector<Point>& stroke) { return stroke.front().x; }
double begins_at(const TextRun& run) { return run.origin.x; }

bool same(const std::vector<Point>& a, const std::vector<Point>& b, double tolerance) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](const Point& p, const Point& q) { return distance(p, q) <= tolerance; });
}
bool same(const TextRun& a, const TextRun& b, double tolerance) {
  return a.text == b.text && a.vertical == b.vertical && distance(a.origin, b.origin) <= tolerance && norm(a.along - b.along) <= tolerance &&
         norm(a.up - b.up) <= tolerance;
}

// Each of `first` with the first free one of `second` that is the same; both come sorted by where they begin.
template <class Thing>
std::size_t matched(std::vector<Thing>& first, std::vector<Thing>& second, double tolerance) {
  const auto earlier = [](const Thing& a, const Thing& b) { return begins_at(a) < begins_at(b); };
  std::stable_sort(first.begin(), first.end(), earlier);
  std::stable_sort(second.begin(), second.end(), earlier);
  std::vector<bool> taken(second.size(), false);
  std::size_t count = 0, from = 0;
  for (const Thing& a : first) {
    while (from < second.size() && (taken[from] || begins_at(second[from]) < begins_at(a) - tolerance)) ++from;
    for (std::size_t i = from; i < second.size() && begins_at(second[i]) <= begins_at(a) + tolerance; ++i) {
      if (taken[i] || !same(a, second[i], tolerance)) continue;
      taken[i] = true;
      ++count;
      break;
    }
  }
  return count;
}

}  // namespace

Result<DraftingComparison> compare_drafting(const Model& first, const Model& second, double tolerance_mm, std::size_t max_instances,
                                            std::size_t max_depth) {
  auto a = placed(first, max_instances, max_depth), b = placed(second, max_instances, max_depth);
  if (!a) return tl::unexpected<Error>(a.error());
  if (!b) return tl::unexpected<Error>(b.error());
  DraftingComparison out;
  out.strokes_same = matched(a->strokes, b->strokes, tolerance_mm);
  out.strokes_first = a->strokes.size() - out.strokes_same;
  out.strokes_second = b->strokes.size() - out.strokes_same;
  out.texts_same = matched(a->texts, b->texts, tolerance_mm);
  out.texts_first = a->texts.size() - out.texts_same;
  out.texts_second = b->texts.size() - out.texts_same;
  return out;
}

}  // namespace trimloop
