#include <functional>

#include "formats/step/records/geometry.h"
#include "formats/step/records/topology.h"
#include "formats/step/rules.h"
#include "io/rules.h"
#include "io/step/construction.h"
#include "io/step/solids.h"
#include "kernel/boolean/boolean.h"
#include "kernel/check/measure.h"
#include "kernel/solids/primitives.h"
#include "kernel/solids/sweep.h"
#include "kernel/topology/transform_body.h"

namespace trimloop::io::step_import {

namespace sr = step::rules;

namespace {

constexpr Entity primitives[] = {Entity::Block, Entity::RightAngularWedge, Entity::RightCircularCylinder,
                                 Entity::RightCircularCone, Entity::SphereSolid, Entity::TorusSolid, Entity::EllipsoidSolid};
constexpr Entity sweeps[] = {Entity::ExtrudedAreaSolid, Entity::RevolvedAreaSolid, Entity::ExtrudedFaceSolid, Entity::RevolvedFaceSolid};

template <std::size_t N>
std::optional<Entity> kind_of(const Context& context, const Record& i, const Entity (&kinds)[N]) {
  for (const Entity e : kinds)
    if (context.is(i, e)) return e;
  return std::nullopt;
}

// The curves of a loop, end to end.
Profile profile_of(const Body& body, const Loop& loop) {
  Profile out;
  for (const Coedge& c : loop.coedges) {
    const Edge& e = body[c.edge];
    if (!e.curve) continue;
    const Curve part = with_range(*e.curve, e.range);
    for (const Curve& piece : pieces_of(c.reversed ? reversed(part) : part)) out.push_back(piece);
  }
  return out;
}

}  // namespace

bool is_construction(const Context& context, const Record& i) {
  return kind_of(context, i, primitives) || kind_of(context, i, sweeps) || context.is(i, Entity::CsgSolid) ||
         context.is(i, Entity::BooleanResult) || context.is(i, Entity::SolidReplica);
}

std::vector<Body> ConstructionReader::failed(const Record& instance, const Error& error) {
  context_.add(instance, rules::unsupported, Severity::Error, "the solid failed: " + error.text, error.measured, error.limit);
  return {};
}

std::vector<Body> ConstructionReader::bodies(const Record& instance) {
  Visit visit(context_, instance);
  if (!visit) return {};
  context_.consume(instance);
  std::vector<Body> out;
  if (context_.is(instance, Entity::CsgSolid)) {
    step::Tape tape;
    step::Reader r(context_.file, instance, context_.execution.limits, tape, context_.report);
    const Ref root = r.at(Entity::CsgSolid) ? r.ref(0) : Ref{};
    const Record* tree = root ? context_.resolve(instance, root, Entity::GeometricRepresentationItem) : nullptr;
    if (tree) out = bodies(*tree);
  } else if (context_.is(instance, Entity::BooleanResult)) {
    out = boolean(instance);
  } else if (context_.is(instance, Entity::SolidReplica)) {
    out = replica(instance);
  } else if (context_.is(instance, Entity::ManifoldSolidBrep)) {
    Body body;
    BrepReader(context_, geometry_, body, [](const Record&, const std::string&) { return AttributesId{}; }).solid(instance);
    if (!body.faces.empty()) out.push_back(std::move(body));
  } else if (kind_of(context_, instance, primitives) || kind_of(context_, instance, sweeps)) {
    auto made = kind_of(context_, instance, primitives) ? primitive(instance) : swept(instance);
    if (!made) return failed(instance, made.error());
    out.push_back(std::move(*made));
  } else {
    context_.add(instance, rules::unsupported, "operands of kind " + std::string(context_.file.keyword(instance).name) + " are not supported");
    return {};
  }
  for (Body& body : out) {
    body.source = {source_of(instance)};
    for (Face& face : body.faces)
      if (face.source.empty()) face.source.push_back(source_of(instance));
    for (Shell& shell : body.shells)
      if (shell.source.empty()) shell.source.push_back(source_of(instance));
  }
  return out;
}

Result<Body> ConstructionReader::primitive(const Record& instance) {
  const Entity kind = *kind_of(context_, instance, primitives);
  step::Tape tape;
  step::Reader r(context_.file, instance, context_.execution.limits, tape, context_.report);
  const auto unreadable = [] { return fail(ErrorCode::InvalidArgument, "its record cannot be used"); };
  if (!r.at(kind)) return unreadable();
  const double mm = geometry_.mm();
  if (kind == Entity::SphereSolid) {
    const double radius = r.real(0) * mm;
    const auto centre = r.ok() ? geometry_.point(instance, r.ref(1)) : std::nullopt;
    return centre ? make_sphere(make_frame(*centre, {0, 0, 1}), radius) : Result<Body>(unreadable());
  }
  const Ref position = r.ref(0);
  const double a = r.real(1), b = r.real(2);
  const double c = kind == Entity::TorusSolid || kind == Entity::RightCircularCylinder ? 0 : r.real(3);
  const double d = kind == Entity::RightAngularWedge ? r.real(4) : 0;
  if (!r.ok()) return unreadable();
  const bool by_axes = kind == Entity::Block || kind == Entity::RightAngularWedge || kind == Entity::EllipsoidSolid;
  const auto f = by_axes ? geometry_.frame(instance, position) : geometry_.axis(instance, position);
  if (!f) return unreadable();
  switch (kind) {
    case Entity::Block: return make_block(*f, a * mm, b * mm, c * mm);
    case Entity::RightAngularWedge: return make_wedge(*f, a * mm, b * mm, c * mm, d * mm);
    case Entity::EllipsoidSolid: return make_ellipsoid(*f, a * mm, b * mm, c * mm);
    case Entity::RightCircularCylinder: return make_cylinder(*f, b * mm, a * mm);
    case Entity::TorusSolid: return make_torus(*f, a * mm, b * mm);
    default: break;
  }
  // A cone: the point on the axis is its apex or its small end, the base lies against the axis.
  const double angle = c * geometry_.units().rad, height = a * mm, top = b * mm;
  if (!(angle > 0) || !(angle < pi / 2)) return fail(ErrorCode::Degenerate, "the half angle of the cone is not between 0 and 90 degrees", angle);
  Frame base = *f;
  base.origin = base.origin - height * base.z;
  return make_cone(base, top + height * std::tan(angle), top, height);
}

// A face in a body of its own, for its border.
std::optional<Body> ConstructionReader::planar_face(const Record& instance) {
  Body body;
  BrepReader reader(context_, geometry_, body, [](const Record&, const std::string&) { return AttributesId{}; });
  const FaceId id = context_.is(instance, Entity::Surface) ? reader.surface_face(instance) : reader.face(instance);
  const Face& face = body[id];
  if (face.status == FaceStatus::Failed || !std::holds_alternative<Plane>(face.surface->shape)) return std::nullopt;
  return body;
}

Result<Body> ConstructionReader::swept(const Record& instance) {
  const Entity kind = *kind_of(context_, instance, sweeps);
  const bool of_face = context_.is(instance, Entity::SweptFaceSolid);
  step::Tape tape;
  step::Reader r(context_.file, instance, context_.execution.limits, tape, context_.report);
  Ref area, along;
  double amount = 0;
  if (r.at(of_face ? Entity::SweptFaceSolid : Entity::SweptAreaSolid)) area = r.ref(0);
  if (r.at(kind)) along = r.ref(0), amount = r.real(1);
  const Record* section = r.ok() ? context_.resolve(instance, area, of_face ? Entity::FaceSurface : Entity::Surface) : nullptr;
  const auto flat = section ? planar_face(*section) : std::nullopt;
  if (!flat) return fail(ErrorCode::Degenerate, "the swept area is no planar face");
  const double tolerance = std::max(geometry_.units().uncertainty_mm, 1e-9);
  const bool extruded = kind == Entity::ExtrudedAreaSolid || kind == Entity::ExtrudedFaceSolid;
  std::function<Result<Body>(Profile)> swept;
  if (extruded) {
    if (const auto direction = geometry_.direction(instance, along))
      swept = [&, by = amount * geometry_.mm() * *direction](Profile p) { return extrude(p, by, tolerance); };
  } else if (const auto axis = geometry_.axis(instance, along)) {
    swept = [&, at = Axis{axis->origin, axis->z}](Profile p) {
      return revolve(std::move(p), at, amount * geometry_.units().rad, false, tolerance);
    };
  }
  if (!swept) return fail(ErrorCode::InvalidArgument, "its direction or axis cannot be used");
  const auto sweep = [&](const Loop& loop) { return swept(profile_of(*flat, loop)); };
  const std::vector<LoopId>& loops = flat->faces.front().loops;
  auto solid = sweep((*flat)[loops.front()]);
  for (std::size_t k = 1; solid && k < loops.size(); ++k) {  // what holes sweep out is taken away
    const auto hole = sweep((*flat)[loops[k]]);
    if (!hole) return hole;
    auto rest = combine(*solid, *hole, BooleanOperation::Difference);
    if (!rest) return tl::unexpected(rest.error());
    if (rest->bodies.size() != 1) return fail(ErrorCode::Degenerate, "the holes of the swept area leave no single solid");
    solid = std::move(rest->bodies.front());
  }
  return solid;
}

std::vector<Body> ConstructionReader::boolean(const Record& instance) {
  step::Tape tape;
  step::Reader r(context_.file, instance, context_.execution.limits, tape, context_.report);
  if (!r.at(Entity::BooleanResult)) return {};
  const std::string word = r.word(0);
  const Ref first = r.ref(1), second = r.ref(2);
  const bool known = word == "UNION" || word == "INTERSECTION" || word == "DIFFERENCE";
  const auto operation = word == "UNION"          ? BooleanOperation::Union
                         : word == "INTERSECTION" ? BooleanOperation::Intersection
                                                  : BooleanOperation::Difference;
  if (!known) context_.add(instance, sr::enum_value, "the operator is none of UNION, INTERSECTION and DIFFERENCE");
  const Record* a = r.ok() ? context_.find(first) : nullptr;
  const Record* b = r.ok() ? context_.find(second) : nullptr;
  if (r.ok() && (!a || !b)) context_.add(instance, sr::reference_unresolved, "an operand is not in the file");
  if (!known || !a || !b) return {};
  const std::vector<Body> left = bodies(*a);
  const std::vector<Body> right = context_.is(*b, Entity::HalfSpaceSolid) ? half_space(*b, left) : bodies(*b);
  if (left.empty() || right.empty()) return failed(instance, {ErrorCode::Degenerate, "an operand gives no solid"});
  auto made = combine(left, right, operation);
  if (!made) return failed(instance, made.error());
  return std::move(made->bodies);
}

// As much of a half space as reaches around what it is to meet.
std::vector<Body> ConstructionReader::half_space(const Record& instance, const std::vector<Body>& around) {
  context_.consume(instance);
  step::Tape tape;
  step::Reader r(context_.file, instance, context_.execution.limits, tape, context_.report);
  if (!r.at(Entity::HalfSpaceSolid)) return {};
  const Ref base = r.ref(0);
  const bool against_normal = r.boolean(1, true);  // the normal points away from the material
  const auto placed = r.ok() ? geometry_.surface(instance, base) : std::nullopt;
  const auto* plane = placed ? std::get_if<Plane>(&placed->surface->shape) : nullptr;
  if (placed && !plane) context_.add(instance, rules::unsupported, "only half spaces with a plane are supported");
  Box box;
  for (const Body& body : around)
    for (std::uint32_t f = 0; f < body.faces.size(); ++f) box.add(bounding_box(body, FaceId{f}));
  if (!plane || box.empty()) return {};
  const Frame& f = plane->frame;
  const double half = 2 * box.diagonal();
  const Point centre = midpoint(box.lo, box.hi), foot = centre - dot(centre - f.origin, f.z) * f.z;
  Frame corner = f;
  corner.origin = foot - half * (f.x + f.y) - (against_normal ? 2 * half : 0) * f.z;
  auto block = make_block(corner, 2 * half, 2 * half, 2 * half);
  if (!block) return failed(instance, block.error());
  for (Face& face : block->faces) face.source.push_back(source_of(instance));
  std::vector<Body> out;
  out.push_back(std::move(*block));
  return out;
}

std::vector<Body> ConstructionReader::replica(const Record& instance) {
  step::Tape tape;
  step::Reader r(context_.file, instance, context_.execution.limits, tape, context_.report);
  if (!r.at(Entity::SolidReplica)) return {};
  const Ref parent_ref = r.ref(0), by_ref = r.ref(1);
  const Record* parent = r.ok() ? context_.resolve(instance, parent_ref, Entity::SolidModel) : nullptr;
  const Record* by = r.ok() ? context_.resolve(instance, by_ref, Entity::CartesianTransformationOperator) : nullptr;
  const auto t = by ? geometry_.transform(*by) : std::nullopt;
  if (!parent || !t) return {};
  const bool was_used = context_.is_consumed(*parent);
  std::vector<Body> out;
  for (const Body& body : bodies(*parent)) {
    auto moved = transformed(body, *t);
    if (!moved) return failed(instance, moved.error());
    out.push_back(std::move(*moved));
  }
  if (!was_used) context_.consume(*parent);
  return out;
}

}  // namespace trimloop::io::step_import
