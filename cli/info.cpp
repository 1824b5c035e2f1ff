// trimloop info: what is in a file, on one screen or as JSON.

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/bytes.h"
#include "base/number.h"
#include "cli/terminal.h"
#include "formats/iges/names.h"
#include "kernel/check/measure.h"

namespace trimloop::cli {

namespace {

using nlohmann::ordered_json;

struct Facts {
  ModelCounts counts;
  ModelMeasures measures;
};

ordered_json to_json(const io::ReadResult& in, const Facts& facts, bool timings) {
  const ModelMeasures& m = facts.measures;
  ordered_json out;
  out["tool"] = {{"name", "trimloop"}, {"version", TRIMLOOP_VERSION}};
  out["file"] = {{"name", printable(in.source.name, 1000)}, {"bytes", in.source.bytes}, {"format", to_string(in.source.format)},
                 {"version", in.source.version}, {"unit", printable(in.source.unit)}, {"unit_known", in.model.unit_known},
                 {"sender", printable(in.source.sender, 1000)}};
  out["entities"] = in.source.entities;
  if (!in.source.pmi.empty()) out["pmi"] = in.source.pmi;
  if (const auto items = io::list_pmi(in.source); !items.empty()) {
    ordered_json& list = out["pmi_items"] = ordered_json::array();
    for (const io::PmiItem& item : items) {
      ordered_json shapes = ordered_json::array();
      for (const std::uint64_t id : item.shapes) shapes.push_back(fmt::format("#{}", id));
      list.push_back({{"id", fmt::format("#{}", item.id)}, {"kind", item.kind}, {"entity", item.entity}, {"name", printable(item.name, 1000)}, {"shapes", shapes}});
    }
  }
  ordered_json box = nullptr;
  if (!m.box.empty()) box = {{m.box.lo.x, m.box.lo.y, m.box.lo.z}, {m.box.hi.x, m.box.hi.y, m.box.hi.z}};
  out["model"] = {{"solids", facts.counts.solids}, {"shells", facts.counts.shells}, {"faces", facts.counts.faces},
                  {"faces_healed", facts.counts.faces_healed}, {"faces_failed", facts.counts.faces_failed},
                  {"edges", facts.counts.edges}, {"curves", facts.counts.curves}, {"points", facts.counts.points},
                  {"length", m.curve_length_mm}, {"bbox", box}, {"area", m.area_mm2},
                  {"volume", m.volume_mm3 ? ordered_json(*m.volume_mm3) : ordered_json(nullptr)}, {"unit", "mm"},
                  {"resolution", in.model.resolution_mm}};
  if (facts.counts.meshes)
    out["model"]["meshes"] = {{"count", facts.counts.meshes}, {"faces", facts.counts.mesh_faces}, {"triangles", facts.counts.mesh_triangles},
                              {"area", m.mesh_area_mm2},
                              {"volume", m.mesh_volume_mm3 ? ordered_json(*m.mesh_volume_mm3) : ordered_json(nullptr)}};
  ordered_json findings;
  for (const Severity s : {Severity::Fatal, Severity::Error, Severity::Warning, Severity::Info, Severity::Hint}) {
    findings[std::string(to_string(s))] = in.report.count(s);
  }
  out["findings"] = findings;
  if (timings) out["milliseconds"] = {{"read", in.timings.read_ms}, {"import", in.timings.import_ms}, {"sew", in.timings.sew_ms}};
  return out;
}

std::string census(const io::SourceInfo& source) {
  std::vector<std::pair<std::size_t, std::string>> rows;
  for (const auto& [key, n] : source.entities) rows.push_back({n, key});
  std::stable_sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::string out;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (i == 8) return out + fmt::format(", {} other kinds", rows.size() - i);
    const bool is_iges = source.format == io::Format::Iges;
    const std::string_view name = is_iges ? iges::entity_name(std::atoi(rows[i].second.c_str())) : std::string_view{};
    out += fmt::format("{}{} {}{}{}", i ? ", " : "", rows[i].first, rows[i].second, name.empty() ? "" : " ", name);
  }
  return out;
}

std::string to_text(const io::ReadResult& in, const Facts& facts, bool timings) {
  const auto& c = facts.counts;
  const auto& m = facts.measures;
  std::string out;
  const auto row = [&out](std::string_view name, const std::string& value) { out += fmt::format("  {:<10} {}\n", name, value); };
  out += fmt::format("{}   {} {}, {} bytes{}{}\n", printable(in.source.name, 200), to_string(in.source.format), in.source.version,
                     in.source.bytes, in.source.date.empty() ? "" : ", written " + printable(in.source.date),
                     in.source.sender.empty() ? "" : fmt::format(" by \"{}\"", printable(in.source.sender)));
  row("units", fmt::format("{}{}; resolution {:.3g} mm", printable(in.source.unit), in.model.unit_known ? "" : " (assumed)",
                           in.model.resolution_mm));
  if (!m.box.empty()) {
    const Vector size = m.box.hi - m.box.lo;
    row("box", fmt::format("{:.6g} x {:.6g} x {:.6g} mm, from ({:.6g}, {:.6g}, {:.6g})", size.x, size.y, size.z, m.box.lo.x,
                           m.box.lo.y, m.box.lo.z));
  }
  std::string model = fmt::format("{} solids, {} shells, {} faces", c.solids, c.shells, c.faces);
  if (c.faces_healed) model += fmt::format(" ({} healed)", c.faces_healed);
  if (c.faces_failed) model += fmt::format(" ({} failed)", c.faces_failed);
  row("model", model + fmt::format(", {} edges, {} free curves, {} free points", c.edges, c.curves, c.points));
  if (c.faces) row("area", fmt::format("{:.9g} mm2", m.area_mm2));
  if (m.volume_mm3) row("volume", fmt::format("{:.9g} mm3", *m.volume_mm3));
  if (c.curves) row("length", fmt::format("{:.9g} mm of free curves", m.curve_length_mm));
  if (c.meshes) {
    std::string text = fmt::format("{} given as triangles: {} faces, {} triangles", c.meshes, c.mesh_faces, c.mesh_triangles);
    if (m.mesh_area_mm2 > 0) text += fmt::format(", area {:.9g} mm2", m.mesh_area_mm2);
    if (m.mesh_volume_mm3) text += fmt::format(", volume {:.9g} mm3", *m.mesh_volume_mm3);
    row("meshes", text);
  }
  row("entities", census(in.source));
  if (!in.source.pmi.empty()) {
    std::string text;
    for (const auto& [kind, n] : in.source.pmi) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", n, kind);
    row("PMI", text + " (kept raw; each with its faces in --json)");
  }
  row("findings", summary(in.report));
  if (timings) row("time", fmt::format("read {:.1f} ms, import {:.1f} ms, sew {:.1f} ms", in.timings.read_ms, in.timings.import_ms, in.timings.sew_ms));
  return out;
}

}  // namespace

int info(const Common& common, const InfoOptions& options) {
  io::ReadOptions read;
  if (!take_sew(options.sew, read)) {
    complain(common, fmt::format("--sew {} is neither auto, off nor a length in mm", printable(options.sew)),
             "trimloop info --sew 0.01 FILE");
    return Usage;
  }
  int worst = Done;
  std::string out;
  for (const std::string& file : options.files) {
    const io::ReadResult in = read_input(common, file, read);
    worst = std::max(worst, exit_code_of(in));
    if (!in.usable) complain_unusable(common, file, in);
    if (in.io_failed || in.limit_reached) continue;
    Facts facts;
    const auto counts = count(in.model, common.execution.limits.instances, common.execution.limits.nesting_depth);
    const auto measures = measure(in.model, common.execution.limits);
    if (!counts || !measures) {
      complain(common, fmt::format("{}: {}", file, (!counts ? counts.error() : measures.error()).text));
      worst = std::max<int>(worst, LimitReached);
      continue;
    }
    facts.counts = *counts;
    facts.measures = *measures;
    out += common.json ? to_json(in, facts, common.timings).dump() + "\n" : to_text(in, facts, common.timings);
  }
  if (!out.empty() && !emit(common, out)) return CannotReadOrWrite;
  return worst;
}

}  // namespace trimloop::cli
