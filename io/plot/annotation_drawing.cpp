#include "io/plot/drawings.h"

namespace trimloop::io::plot {

// Strokes as they are; each run of text in its box, the letters in the size of the page.
Canvas draw_annotation(const std::string& title, const std::vector<Annotation>& annotation) {
  Box box;
  std::vector<Point> all;
  const auto corners = [](const TextRun& t) {
    return std::vector<Point>{t.origin, t.origin + t.along, t.origin + t.along + t.up, t.origin + t.up};
  };
  for (const Annotation& a : annotation) {
    for (const auto& stroke : a.strokes) all.insert(all.end(), stroke.begin(), stroke.end());
    for (const TextRun& t : a.texts)
      for (const Point& p : corners(t)) all.push_back(p);
  }
  for (const Point& p : all) box.add(p);
  const View view = view_of(box);
  Canvas canvas(title, page_box(view, all), 700, 520);
  const auto on_page = [&](std::vector<Point> points) {
    for (Point& p : points) p = view(p);
    return points;
  };
  for (const Annotation& a : annotation) {
    for (const auto& stroke : a.strokes) canvas.polyline(on_page(stroke), {blue});
    for (const TextRun& t : a.texts) {
      canvas.polygon(on_page(corners(t)), {light, 1});
      canvas.label(view(t.origin), t.text, ink, 0, 0);
    }
  }
  return canvas;
}

}  // namespace trimloop::io::plot
