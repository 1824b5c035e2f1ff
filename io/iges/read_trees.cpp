// Boolean trees (180) and selected components (182) -> solids.

#include <fmt/format.h>

#include "io/iges/attributes.h"
#include "io/iges/placement.h"
#include "io/iges/trees.h"
#include "io/rules.h"
#include "kernel/topology/transform_body.h"

namespace trimloop::io::iges_import {
namespace {

std::string_view name_of_operator(std::int32_t code) {
  return code == 1 ? "union" : code == 2 ? "intersection" : "difference";
}

Result<std::vector<Body>> moved_bodies(std::vector<Body> bodies, const Transform& by) {
  if (is_identity(by)) return bodies;
  for (Body& body : bodies) {
    auto moved = transformed(body, by);
    if (!moved) return tl::unexpected<Error>(moved.error());
    body = std::move(*moved);
  }
  return bodies;
}

std::size_t faces_of(const std::vector<Body>& bodies) {
  std::size_t n = 0;
  for (const Body& b : bodies) n += b.faces.size();
  return n;
}

bool is_tree(const DirectoryEntry& e) { return e.type == 180; }

}  // namespace

bool is_operand(const DirectoryEntry& e) {
  return is_primitive(e) || e.type == 180 || e.type == 182 || e.type == 186 || e.type == 430;
}

const Result<std::vector<Body>>& TreeReader::solids(const DirectoryEntry& entry) {
  const auto known = known_.find(entry.de);
  if (known != known_.end()) return known->second;
  return known_.emplace(entry.de, read(entry)).first->second;
}

Result<std::vector<Body>> TreeReader::read(const DirectoryEntry& entry) {
  if (is_primitive(entry) || entry.type == 186) {
    auto body = solid_(entry);
    if (!body) return fail(ErrorCode::Degenerate, fmt::format("operand {} is no solid", name_of(entry)));
    return std::vector<Body>{std::move(*body)};
  }
  Visit visit(context_, entry);
  if (!visit) return fail(ErrorCode::Limit, "an operand is part of itself, or nested too deeply");
  context_.state(entry).consumed = true;
  const iges::TableRecord* record = context_.table(entry);
  if (!record) return fail(ErrorCode::InvalidArgument, fmt::format("the record of operand {} cannot be used", name_of(entry)));
  if (entry.type == 182) return component(entry, *record);
  if (entry.type == 430) {
    const DirectoryEntry* base = context_.resolve(record->ref("DE"), is_operand, "a solid");
    if (!base) return fail(ErrorCode::NotFound, fmt::format("instance {} names no solid", name_of(entry)));
    const auto& solid = solids(*base);
    return solid ? moved_bodies(*solid, model_placement(context_, entry)) : solid;
  }
  auto result = evaluated(entry, *record);
  return result ? moved_bodies(std::move(*result), model_placement(context_, entry)) : result;
}

// The expression in postfix order: operands are -DE, operators 1 union, 2 intersection, 3 difference (its record's reader has
// seen to it that they match).
Result<std::vector<Body>> TreeReader::evaluated(const DirectoryEntry& entry, const iges::TableRecord& record) {
  std::vector<std::vector<Body>> stack;
  std::size_t step = 0;
  for (const iges::TableRecord::Value& value : record.values) {
    const Ref* term = std::get_if<Ref>(&value);
    if (!term) continue;
    if (term->de < 0) {
      const DirectoryEntry* operand = context_.resolve(Ref{-term->de}, is_operand, "a solid");
      if (!operand) return fail(ErrorCode::NotFound, "an operand is no solid");
      const auto& solid = solids(*operand);
      if (!solid) return tl::unexpected<Error>(solid.error());
      stack.push_back(*solid);
      continue;
    }
    ++step;
    if (stack.size() < 2) return fail(ErrorCode::InvalidArgument, "an operator has less than two operands");
    const std::vector<Body> second = std::move(stack.back());
    stack.pop_back();
    if (context_.execution.stop.stop_requested()) return fail(ErrorCode::Cancelled, "the import was interrupted");
    pairs_ += faces_of(stack.back()) * faces_of(second);
    if (pairs_ > most_pairs)
      return fail(ErrorCode::Limit, "more pairs of faces to compare than the limit", static_cast<double>(pairs_),
                  static_cast<double>(most_pairs));
    const BooleanOperation operation = term->de == 1   ? BooleanOperation::Union
                                       : term->de == 2 ? BooleanOperation::Intersection
                                                       : BooleanOperation::Difference;
    auto combined = combine(stack.back(), second, operation);
    if (!combined) {
      Error e = combined.error();
      e.text = fmt::format("operator {} of tree {} ({}): {}", step, name_of(entry), name_of_operator(term->de), e.text);
      return tl::unexpected<Error>(std::move(e));
    }
    bound_mm_ = std::max(bound_mm_, combined->bound_mm);
    stack.back() = std::move(combined->bodies);
  }
  if (stack.size() != 1) return fail(ErrorCode::InvalidArgument, "the expression leaves no single operand");
  return std::move(stack.front());
}

// 182: the piece of the tree's solid that the point lies in or on.
Result<std::vector<Body>> TreeReader::component(const DirectoryEntry& entry, const iges::TableRecord& record) {
  const DirectoryEntry* tree = context_.resolve(record.ref("BTREE"), is_tree, "a Boolean tree (180)");
  if (!tree) return fail(ErrorCode::NotFound, "the component's Boolean tree is missing");
  const auto& whole = solids(*tree);
  if (!whole) return whole;
  const double mm = context_.unit.scale;
  const iges::Xyz at = record.xyz("SELX", "SELY", "SELZ");
  const Point p{at.x * mm, at.y * mm, at.z * mm};
  const auto chosen = solid_at(*whole, p, context_.resolution_mm);
  if (!chosen) return fail(ErrorCode::NotFound, "the point of the selected component lies in no piece of the tree's solid");
  return moved_bodies({(*whole)[*chosen]}, model_placement(context_, entry));
}

}  // namespace trimloop::io::iges_import
