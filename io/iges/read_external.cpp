// 416: definitions and whole files that stand in another file. Nothing is opened here; the caller's resolver is asked, with
// the name as the file has it.

#include <fmt/format.h>

#include <algorithm>

#include "base/bytes.h"
#include "formats/iges/rules.h"
#include "io/iges/import.h"
#include "io/iges/placement.h"
#include "io/iges/structure.h"
#include "io/names.h"
#include "kernel/model/append.h"

namespace trimloop::io::iges_import {
namespace {

namespace igr = iges::rules;

bool is_plain_name(std::string_view name) {
  constexpr std::size_t longest = 255;
  const auto odd = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == '/' || c == '\\' || c == ':' || c == '\x7f'; };
  return !name.empty() && name.size() <= longest && name != "." && name != ".." && std::none_of(name.begin(), name.end(), odd);
}

// Forms 0 and 2 name a file and a definition in it, 1 a file, 3 a definition, 4 a definition and a library.
ExternalReference reference(const iges::TableRecord& record) {
  ExternalReference out;
  out.file = record.string("FNAME");
  out.name = record.string("DNAME");
  out.library = record.string("LNAME");
  out.is_plain = out.file.empty() || is_plain_name(out.file);
  return out;
}

std::string described(const ExternalReference& r) {
  std::string out = r.file.empty() ? fmt::format("the definition '{}'", printable(r.name)) : fmt::format("the file '{}'", printable(r.file));
  if (!r.file.empty() && !r.is_plain) out += ", which is no plain file name";
  if (!r.library.empty()) out += fmt::format(" of the library '{}'", printable(r.library));
  return out;
}

std::optional<std::uint32_t> part_named(const Model& model, const std::string& name, std::uint32_t from) {
  for (std::uint32_t i = from; i < model.parts.size(); ++i)
    if (model.parts[i].name == name) return i;
  return std::nullopt;
}

}  // namespace

bool is_external(const DirectoryEntry& e) { return e.type == 416; }

// The part that an entity 416 stands for, read once.
std::optional<std::uint32_t> StructureReader::external_part(const DirectoryEntry& entry) {
  const auto [at, fresh] = external_.try_emplace(entry.de);
  if (!fresh) return at->second;
  context_.state(entry).consumed = true;
  const iges::TableRecord* record = context_.table(entry);
  if (!record) return std::nullopt;
  const ExternalReference ref = reference(*record);
  if (escapes_folder(ref.file))
    context_.add(entry, name_rules::path_escape, fmt::format("the file '{}' lies outside this one's folder", printable(ref.file, 200)));
  const auto refuse = [&](const std::string& why) {
    context_.add(entry, igr::external_ref, "this stands for " + described(ref) + why);
    return std::nullopt;
  };
  External& external = context_.external;
  if (!external.resolve) return refuse("; files are not opened on their own, and the model is without it");
  if (external.depth >= deepest_external_file || *external.opened >= most_external_files)
    return refuse("; too many files name each other, and the model is without it");
  ++*external.opened;
  auto bytes = (*external.resolve)(ref);
  if (!bytes) return refuse("; it was not given, and the model is without it");
  Report report;
  const iges::File file = iges::File::parse(std::move(*bytes), context_.execution.limits, report);
  Model model;
  if (!report.has_fatal()) {
    External below = external;
    ++below.depth;
    model = import(file, context_.execution, {}, report, false, below);
  }
  if (report.has_fatal() || model.parts.empty()) return refuse("; what was given is no usable IGES file");
  // Numbers of entities in there would be taken for those of this file.
  for (Part& part : model.parts) {
    part.source = {source_of(entry)};
    for (Body& body : part.bodies) {
      body.source = {source_of(entry)};
      for (Face& face : body.faces) face.source = {source_of(entry)};
    }
    for (FreeCurve& c : part.curves) c.source = {source_of(entry)};
    for (FreePoint& p : part.points) p.source = {source_of(entry)};
    for (Annotation& a : part.annotation) a.source = {source_of(entry)};
    for (Instance& i : part.instances) i.source = {source_of(entry)};
  }
  for (const Diagnostic& d : report.items())
    if (d.severity >= Severity::Error || d.rule->id == igr::external_ref.id) context_.add(entry, *d.rule, d.severity, fmt::format("{}: {}", printable(ref.file), d.text), d.measured, d.limit);
  const std::uint32_t root = append(model_, std::move(model));
  definitions_.resize(model_.parts.size(), nullptr);
  if (!ref.name.empty()) {
    const auto named = part_named(model_, ref.name, root);
    if (!named && !ref.file.empty()) return refuse(fmt::format("; it has no definition '{}'", printable(ref.name)));
    at->second = named.value_or(root);
  } else {
    at->second = root;
  }
  return at->second;
}

// A reference that no copy uses (forms 0 and 1) stands for itself; the others are links without a shape.
void StructureReader::add_external(std::uint32_t part, const DirectoryEntry& entry) {
  const auto found = external_part(entry);
  if (found && entry.form <= 1) place(part, entry, *found, model_placement(context_, entry));
}

}  // namespace trimloop::io::iges_import
