#include "io/step/pmi.h"

#include <algorithm>
#include <set>
#include <unordered_map>

#include "formats/step/file.h"
#include "formats/step/records/reader.h"
#include "formats/step/strings.h"
#include "formats/step/tape.h"
#include "io/io.h"

namespace trimloop::io {
namespace {

using step::Entity;

bool has(std::string_view keyword, std::string_view word) { return keyword.find(word) != std::string_view::npos; }

class Lister {
 public:
  Lister(const step::File& file, const Limits& limits) : file_(file), limits_(limits) {}

  std::vector<PmiItem> run() {
    read_ties();
    std::vector<PmiItem> out;
    for (const step::Instance& i : file_.instances()) {
      const step::Keyword& keyword = file_.keyword(i);
      const std::string_view kind = pmi_kind(keyword.name);
      if (kind.empty()) continue;
      PmiItem& item = out.emplace_back();
      item.id = i.id;
      item.kind = kind;
      item.entity = keyword.name;
      item.name = name_of(i);
      item.shapes = shapes_of(i);
    }
    return out;
  }

 private:
  std::vector<std::uint64_t> references(const step::Instance& i) {
    std::vector<std::uint64_t> out;
    tape_.read(file_.value(i), limits_);
    for (std::uint32_t t = 0; t < tape_.size(); ++t)
      if (tape_[t].kind == step::Token::Kind::Reference) out.push_back(tape_[t].id);
    return out;
  }

  std::string name_of(const step::Instance& i) {
    tape_.read(file_.value(i), limits_);
    for (std::uint32_t t = 0; t < tape_.size(); ++t)
      if (tape_[t].kind == step::Token::Kind::String && tape_[t].length > 0) return step::decode_string(tape_.text(tape_[t]));
    return {};
  }

  // What hangs on an aspect from outside: items of its usages, members of a composite one, the meaning of an annotation
  // or of the callout that it is part of.
  void read_ties() {
    for (const step::Instance& i : file_.instances()) {
      const std::string_view keyword = file_.keyword(i).name;
      const bool usage = has(keyword, "GEOMETRIC_ITEM_SPECIFIC_USAGE") || has(keyword, "ITEM_IDENTIFIED_REPRESENTATION_USAGE");
      const bool association = has(keyword, "DRAUGHTING_MODEL_ITEM_ASSOCIATION");
      const bool relation = has(keyword, "SHAPE_ASPECT_RELATIONSHIP") || has(keyword, "FEATURE_FOR_DATUM_TARGET_RELATIONSHIP") ||
                            has(keyword, "SHAPE_ASPECT_ASSOCIATIVITY") || has(keyword, "SHAPE_ASPECT_DERIVING_RELATIONSHIP");
      const bool callout = has(keyword, "CALLOUT") && !has(keyword, "CALLOUT_RELATIONSHIP");
      if (!usage && !association && !relation && !callout) continue;
      const std::vector<std::uint64_t> r = references(i);
      if (callout) {
        for (const std::uint64_t content : r) tied_[content].push_back(i.id);
        continue;
      }
      if (r.size() < 2) continue;
      if (relation) {
        tied_[r[0]].push_back(r[1]);
        if (is_datum(r[1])) tied_[r[1]].push_back(r[0]);  // a datum is what its feature shows
      } else if (usage) {
        tied_[r[0]].insert(tied_[r[0]].end(), r.begin() + 2 - (r.size() == 2), r.end());
      } else {
        tied_[r.back()].push_back(r[0]);
      }
    }
  }
  bool is_datum(std::uint64_t id) const {
    const step::Instance* i = file_.find({id});
    return i && file_.keyword(*i).name == "DATUM";
  }

  // Down the references among what belongs to PMI, and over the ties, to the first shapes.
  std::vector<std::uint64_t> shapes_of(const step::Instance& from) {
    std::vector<std::uint64_t> todo{from.id}, found;
    std::set<std::uint64_t> seen{from.id};
    while (!todo.empty()) {
      const std::uint64_t id = todo.back();
      todo.pop_back();
      std::vector<std::uint64_t> next;
      if (const auto tied = tied_.find(id); tied != tied_.end()) next = tied->second;
      const step::Instance* i = file_.find({id});
      if (i && !file_.is(*i, Entity::DraughtingModel)) {
        const auto below = references(*i);
        next.insert(next.end(), below.begin(), below.end());
      }
      for (const std::uint64_t n : next) {
        const step::Instance* target = file_.find({n});
        if (!target || !seen.insert(n).second) continue;
        const bool shape = file_.is(*target, Entity::TopologicalRepresentationItem) || file_.is(*target, Entity::SolidModel);
        const std::string_view keyword = file_.keyword(*target).name;
        if (shape) found.push_back(n);
        else if (is_pmi(keyword) && !has(keyword, "DATUM_SYSTEM") && !has(keyword, "DATUM_REFERENCE")) todo.push_back(n);
      }
    }
    std::sort(found.begin(), found.end());
    return found;
  }

  const step::File& file_;
  const Limits& limits_;
  step::Tape tape_;
  std::unordered_map<std::uint64_t, std::vector<std::uint64_t>> tied_;
};

}  // namespace

std::string_view pmi_kind(std::string_view keyword) {
  constexpr std::string_view tolerance = "_TOLERANCE";
  if (has(keyword, "DIMENSIONAL_SIZE") || has(keyword, "DIMENSIONAL_LOCATION") || has(keyword, "ANGULAR_LOCATION")) return "dimensions";
  if (has(keyword, "GEOMETRIC_TOLERANCE_RELATIONSHIP")) return {};
  if (has(keyword, "GEOMETRIC_TOLERANCE") ||
      (keyword.size() > tolerance.size() && keyword.substr(keyword.size() - tolerance.size()) == tolerance))
    return "tolerances";
  if (keyword == "DATUM" || has(keyword, "DATUM_TARGET") || has(keyword, "+DATUM+")) return "datums";
  if (has(keyword, "ANNOTATION_") && has(keyword, "OCCURRENCE")) return "annotations";
  if (has(keyword, "CAMERA_MODEL_D3")) return "views";
  return {};
}

std::map<std::string, std::size_t> count_properties(const step::File& file, const Limits& limits) {
  std::map<std::string, std::size_t> out;
  step::Tape tape;
  Report quiet;
  for (const step::Instance& i : file.instances()) {
    if (!file.is(i, Entity::PropertyDefinition) || file.is(i, Entity::ProductDefinitionShape)) continue;
    step::Reader r(file, i, limits, tape, quiet);
    if (!r.at(Entity::PropertyDefinition, true) || r.count() < 3) continue;
    const std::string name = r.text(0);
    const step::Instance* of = file.find(r.select(2).ref);
    if (of && file.is(*of, Entity::ProductDefinitionShape)) {
      step::Reader shape(file, *of, limits, tape, quiet);
      of = shape.at(Entity::PropertyDefinition, true) && shape.count() > 2 ? file.find(shape.select(2).ref) : nullptr;
    }
    const bool of_part = of && (file.is(*of, Entity::ProductDefinition) || file.is(*of, Entity::ProductDefinitionRelationship));
    if (of_part && name.find("validation property") == std::string::npos) ++out[name];
  }
  return out;
}

bool is_pmi(std::string_view keyword) {
  if (!pmi_kind(keyword).empty()) return true;
  for (const std::string_view word :
       {"SHAPE_ASPECT", "DATUM", "TOLERANCE", "DIMENSIONAL_CHARACTERISTIC", "DIMENSION_RELATED", "ANGULAR_SIZE", "ANNOTATION_",
        "DRAUGHTING_CALLOUT", "DIRECTED_CALLOUT", "STRUCTURED_DIMENSION_CALLOUT", "DRAUGHTING_MODEL", "MODEL_GEOMETRIC_VIEW",
        "CAMERA_IMAGE_3D", "GEOMETRIC_ITEM_SPECIFIC_USAGE", "ITEM_IDENTIFIED_REPRESENTATION_USAGE"})
    if (has(keyword, word)) return true;
  return false;
}

std::vector<PmiItem> list_pmi(const SourceInfo& source, const Limits& limits) {
  if (!source.step || source.pmi.empty()) return {};
  return Lister(*source.step, limits).run();
}

}  // namespace trimloop::io
