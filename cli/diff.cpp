// trimloop diff: what two files have in common and what not, whatever their formats.

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "base/bytes.h"
#include "cli/terminal.h"
#include "kernel/check/compare.h"
#include "kernel/check/compare_drafting.h"
#include "kernel/check/measure.h"

namespace trimloop::cli {

namespace {

using nlohmann::ordered_json;

struct FileFacts {
  io::ReadResult in;
  ModelCounts counts;
  ModelMeasures measures;
};

struct Count {  // of one kind of thing, on both sides
  std::string what;
  std::size_t first = 0, second = 0;
};

std::vector<Count> census(const FileFacts& a, const FileFacts& b) {
  std::vector<Count> rows;
  if (a.in.source.format != b.in.source.format) return rows;
  std::set<std::string> kinds;
  for (const auto& [kind, n] : a.in.source.entities) kinds.insert(kind);
  for (const auto& [kind, n] : b.in.source.entities) kinds.insert(kind);
  for (const std::string& kind : kinds) {
    const auto of = [&](const FileFacts& f) {
      const auto found = f.in.source.entities.find(kind);
      return found == f.in.source.entities.end() ? 0 : found->second;
    };
    if (of(a) != of(b)) rows.push_back({kind, of(a), of(b)});
  }
  return rows;
}

std::vector<Count> counts(const FileFacts& a, const FileFacts& b) {
  const ModelCounts &x = a.counts, &y = b.counts;
  std::vector<Count> rows;
  for (const Count& row : {Count{"solids", x.solids, y.solids}, Count{"faces", x.faces, y.faces},
                           Count{"faces that failed", x.faces_failed, y.faces_failed}, Count{"free curves", x.curves, y.curves},
                           Count{"free points", x.points, y.points}}) {
    if (row.first != row.second) rows.push_back(row);
  }
  return rows;
}

std::string source_of(const FileFacts& f, const std::optional<FacePlace>& p) {
  if (!p) return {};
  const Face& face = f.in.model.parts[p->part].bodies[p->body].faces[p->face.index];
  return face.source.empty() ? std::string("?") : io::source_name(f.in.source.format, face.source.front());
}

std::string sentence(const FileFacts& a, const FileFacts& b, const FacePair& p) {
  const std::string first = source_of(a, p.first), second = source_of(b, p.second);
  switch (p.difference) {
    case Difference::Same:
      if (p.renamed || p.recoloured) break;
      return fmt::format("{} and {}: at most {:.4g} mm apart", first, second, p.deviation_mm);
    case Difference::Changed:
      return fmt::format("{} and {}: up to {:.4g} mm apart, area {:.8g} and {:.8g} mm2", first, second, p.deviation_mm,
                         p.area_first_mm2, p.area_second_mm2);
    case Difference::Moved: return fmt::format("{} is {} moved by {:.6g} mm", second, first, p.deviation_mm);
    case Difference::OnlyFirst: return fmt::format("{} is in the first file only, area {:.8g} mm2", first, p.area_first_mm2);
    case Difference::OnlySecond: return fmt::format("{} is in the second file only, area {:.8g} mm2", second, p.area_second_mm2);
  }
  const char* what = p.renamed && p.recoloured ? "another name and colour" : p.renamed ? "another name" : "another colour";
  return fmt::format("{} and {}: {}", first, second, what);
}

bool is_listed(const FacePair& p) { return p.difference != Difference::Same || p.renamed || p.recoloured; }

bool differs(const Comparison& c, const DraftingComparison& drafting, const std::vector<Count>& rows) {
  return !rows.empty() || !drafting.same() || std::any_of(c.faces.begin(), c.faces.end(), is_listed) || c.curves_first || c.curves_second ||
         c.points_first || c.points_second;
}

std::size_t renamed(const Comparison& c) {
  return static_cast<std::size_t>(std::count_if(c.faces.begin(), c.faces.end(), [](const FacePair& p) { return p.renamed; }));
}
std::size_t recoloured(const Comparison& c) {
  return static_cast<std::size_t>(std::count_if(c.faces.begin(), c.faces.end(), [](const FacePair& p) { return p.recoloured; }));
}

std::string text(const FileFacts& a, const FileFacts& b, const Comparison& c, const DraftingComparison& drafting, double tolerance, bool same,
                 bool all_faces) {
  std::string out;
  const auto line = [&](std::string_view name, const std::string& what) { out += fmt::format("  {:<10} {}\n", name, what); };
  out += fmt::format("{} ({}) and {} ({}): {}\n", a.in.source.name, to_string(a.in.source.format), b.in.source.name,
                     to_string(b.in.source.format), same ? "the same" : "they differ");
  line("faces", fmt::format("{} the same within {:.3g} mm (at most {:.3g} apart), {} changed, {} moved, {} only in the first, {} "
                            "only in the second",
                            c.count(Difference::Same), tolerance, c.max_deviation_mm, c.count(Difference::Changed),
                            c.count(Difference::Moved), c.count(Difference::OnlyFirst), c.count(Difference::OnlySecond)));
  if (renamed(c) || recoloured(c)) line("", fmt::format("{} with another name, {} with another colour", renamed(c), recoloured(c)));
  if (c.reordered) line("", "they come in another order");
  if (c.failed_first || c.failed_second) {
    line("", fmt::format("not compared, since they failed: {} and {}", c.failed_first, c.failed_second));
  }
  if (c.curves_same + c.curves_first + c.curves_second) {
    line("curves", fmt::format("{} the same, {} only in the first, {} only in the second", c.curves_same, c.curves_first,
                               c.curves_second));
  }
  if (c.points_same + c.points_first + c.points_second) {
    line("points", fmt::format("{} the same, {} only in the first, {} only in the second", c.points_same, c.points_first,
                               c.points_second));
  }
  const auto left_over = [&](std::string_view what, std::size_t both, std::size_t first, std::size_t second) {
    if (both + first + second) line(what, fmt::format("{} the same, {} only in the first, {} only in the second", both, first, second));
  };
  left_over("texts", drafting.texts_same, drafting.texts_first, drafting.texts_second);
  left_over("strokes", drafting.strokes_same, drafting.strokes_first, drafting.strokes_second);
  for (const Count& row : counts(a, b)) line("model", fmt::format("{}: {} and {}", row.what, row.first, row.second));
  if (a.in.model.source_unit != b.in.model.source_unit) {
    line("unit", fmt::format("{} and {}", to_string(a.in.model.source_unit), to_string(b.in.model.source_unit)));
  }
  for (const Count& row : census(a, b)) line("entities", fmt::format("{}: {} and {}", row.what, row.first, row.second));
  const std::size_t most = all_faces ? c.faces.size() : 50;
  std::size_t listed = 0, all = 0;
  for (const FacePair& p : c.faces) {
    if (!all_faces && !is_listed(p)) continue;
    if (++all <= most) line(to_string(p.difference), sentence(a, b, p)), ++listed;
  }
  if (all > listed) line("", fmt::format("and {} more; --json lists all", all - listed));
  return out;
}

ordered_json rows_json(const std::vector<Count>& rows) {
  ordered_json out = ordered_json::object();
  for (const Count& row : rows) out[printable(row.what)] = {row.first, row.second};
  return out;
}

ordered_json json(const FileFacts& a, const FileFacts& b, const Comparison& c, const DraftingComparison& drafting, double tolerance, bool same,
                  bool all_faces) {
  const auto side = [](const FileFacts& f) {
    return ordered_json{{"file", printable(f.in.source.name, 1000)}, {"format", to_string(f.in.source.format)},
                        {"unit", to_string(f.in.model.source_unit)}, {"faces", f.counts.faces}, {"solids", f.counts.solids},
                        {"area", f.measures.area_mm2},
                        {"volume", f.measures.volume_mm3 ? ordered_json(*f.measures.volume_mm3) : ordered_json(nullptr)}};
  };
  ordered_json out;
  out["same"] = same;
  out["tolerance"] = tolerance;
  out["first"] = side(a);
  out["second"] = side(b);
  out["model"] = rows_json(counts(a, b));
  out["entities"] = rows_json(census(a, b));
  ordered_json faces;
  for (const Difference d : {Difference::Same, Difference::Changed, Difference::Moved, Difference::OnlyFirst, Difference::OnlySecond}) {
    faces[std::string(to_string(d))] = c.count(d);
  }
  faces["renamed"] = renamed(c);
  faces["recoloured"] = recoloured(c);
  faces["reordered"] = c.reordered;
  faces["failed"] = {c.failed_first, c.failed_second};
  faces["max_deviation"] = c.max_deviation_mm;
  out["faces"] = faces;
  out["curves"] = {{"same", c.curves_same}, {"only-first", c.curves_first}, {"only-second", c.curves_second}};
  out["points"] = {{"same", c.points_same}, {"only-first", c.points_first}, {"only-second", c.points_second}};
  out["texts"] = {{"same", drafting.texts_same}, {"only-first", drafting.texts_first}, {"only-second", drafting.texts_second}};
  out["strokes"] = {{"same", drafting.strokes_same}, {"only-first", drafting.strokes_first}, {"only-second", drafting.strokes_second}};
  out["pairs"] = ordered_json::array();
  for (const FacePair& p : c.faces) {
    if (!all_faces && !is_listed(p)) continue;
    out["pairs"].push_back({{"difference", to_string(p.difference)}, {"first", source_of(a, p.first)},
                            {"second", source_of(b, p.second)}, {"deviation", p.deviation_mm},
                            {"area", {p.area_first_mm2, p.area_second_mm2}}, {"renamed", p.renamed},
                            {"recoloured", p.recoloured}});
  }
  return out;
}

}  // namespace

int diff(const Common& common, const DiffOptions& options) {
  FileFacts sides[2];
  for (int k = 0; k < 2; ++k) {
    const std::string& path = k == 0 ? options.first : options.second;
    io::ReadOptions read;
    read.sew = true;  // loose faces in one file may be a solid in the other
    sides[k].in = read_input(common, path, read);
    if (!sides[k].in.usable) {
      complain_unusable(common, path, sides[k].in);
      return exit_code_of(sides[k].in);
    }
    const auto n = count(sides[k].in.model, common.execution.limits.instances, common.execution.limits.nesting_depth);
    const auto m = measure(sides[k].in.model, common.execution.limits);
    if (!n || !m) {
      complain(common, fmt::format("{}: {}", path, n ? m.error().text : n.error().text));
      return LimitReached;
    }
    sides[k].counts = *n;
    sides[k].measures = *m;
  }
  const FileFacts &a = sides[0], &b = sides[1];
  CompareOptions compare_options;
  compare_options.execution = common.execution;
  compare_options.tolerance_mm = options.tolerance_mm > 0 ? options.tolerance_mm
                                                          : std::max(a.in.model.resolution_mm, b.in.model.resolution_mm);
  const auto c = compare(a.in.model, b.in.model, compare_options);
  if (!c) {
    complain(common, c.error().text);
    return LimitReached;
  }
  const auto drafting = compare_drafting(a.in.model, b.in.model, compare_options.tolerance_mm, common.execution.limits.instances,
                                         common.execution.limits.nesting_depth);
  if (!drafting) {
    complain(common, drafting.error().text);
    return LimitReached;
  }
  const bool same = !differs(*c, *drafting, counts(a, b));
  const double tolerance = compare_options.tolerance_mm;
  const std::string data = common.json ? json(a, b, *c, *drafting, tolerance, same, options.all).dump(2) + "\n"
                                       : text(a, b, *c, *drafting, tolerance, same, options.all);
  if (!emit(common, data)) return CannotReadOrWrite;
  return same ? Done : Findings;
}

}  // namespace trimloop::cli
