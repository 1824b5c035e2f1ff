#include "io/sew.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/rules.h"
#include "kernel/heal/sew.h"

namespace trimloop::io {
namespace {

std::string name_of(Format format, const SourceRefs& source) {
  return source.empty() ? std::string() : source_name(format, source.front());
}

void report_open(const Body& body, const heal::OpenEdge& open, Format format, double tolerance_mm, Report& report) {
  const Face& face = body[open.face];
  const bool near = open.gap_mm >= 0;
  Diagnostic d;
  d.rule = &rules::free_edge;
  d.severity = near && open.gap_mm <= 100 * tolerance_mm ? Severity::Warning : Severity::Info;
  d.text = near ? fmt::format("an edge of the face belongs to no other face; the nearest one that is open too is {:.3g} mm away",
                              open.gap_mm)
                : "an edge of the face belongs to no other face, and none is near";
  d.entity = name_of(format, face.source);
  if (near) {
    d.measured = open.gap_mm;
    d.limit = tolerance_mm;
    d.unit = "mm";
  }
  d.at = {open.at.x, open.at.y, open.at.z};
  report.add(std::move(d));
}

std::string sentence(const heal::SewReport& r, double tolerance_mm, std::size_t open) {
  return fmt::format("sewn at {:.3g} mm: {} pairs of edges joined, {} cut in parts, {} without length; {} closed and {} open "
                     "shells, {} of the closed ones voids, {} faces turned, {} places where more than two edges meet; {} edges stay open",
                     tolerance_mm, r.joined, r.splits, r.collapsed, r.closed_shells, r.open_shells, r.voids, r.turned_faces,
                     r.non_manifold, open);
}

}  // namespace

namespace {

// What a body says of its faces goes with them, as they may end in another body.
void hand_down(Model& model, Body& body) {
  const Attributes whole = model[body.attributes];
  if (whole.name.empty() && !whole.colour) return;
  for (Face& face : body.faces) {
    Attributes own = model[face.attributes];
    if (own.name.empty()) own.name = whole.name;
    if (!own.colour) own.colour = whole.colour;
    face.attributes = model.add(own);
  }
}

// Hidden faces stay apart from visible ones by their attributes; solids of the file stay as they are.
std::vector<Body> take_sheets(Part& part) {
  std::vector<Body> sheets;
  for (Body& body : part.bodies)
    if (body.kind == BodyKind::Sheet && !body.faces.empty()) sheets.push_back(std::move(body)), body.faces.clear();
  std::erase_if(part.bodies, [](const Body& b) { return b.kind == BodyKind::Sheet && b.faces.empty(); });
  return sheets;
}

}  // namespace

void sew(Model& model, Format format, double tolerance_mm, bool measure_gaps, const std::stop_token& stop, Report& report) {
  for (Part& part : model.parts) {
    std::vector<Body> sheets = take_sheets(part);
    if (sheets.empty()) continue;
    std::size_t faces = 0;
    for (Body& body : sheets) {
      faces += body.faces.size();
      if (sheets.size() > 1) hand_down(model, body);
    }
    const SourceRefs source = sheets.size() == 1 ? sheets[0].source : part.source;
    heal::SewResult result = heal::sew(std::move(sheets), {tolerance_mm, measure_gaps, stop});
    if (result.stopped) return;
    std::size_t open = 0;
    for (const heal::SewReport& r : result.reports) open += r.open.size();
    const heal::SewReport& whole = result.reports.front();
    if (faces > 1 && (open > 0 || whole.joined > 0)) {
      Diagnostic& d = report.add(rules::sew_report, sentence(whole, tolerance_mm, open));
      d.entity = name_of(format, source);
      d.measured = whole.max_gap_mm;
      d.limit = tolerance_mm;
      d.unit = "mm";
      for (std::size_t i = 0; measure_gaps && i < result.bodies.size(); ++i)
        for (const heal::OpenEdge& o : result.reports[i].open)
          report_open(result.bodies[i], o, format, tolerance_mm, report);
    }
    for (Body& b : result.bodies) part.bodies.push_back(std::move(b));
  }
}

}  // namespace trimloop::io
