#include "io/step/export.h"

#include <fmt/format.h>

#include <cmath>

#include "io/step/product_writer.h"

namespace trimloop::io::step_export {

namespace {

constexpr std::string_view null_stamp = "0001-01-01T00:00:00";

// "YYYYMMDD.HHNNSS" as options have it, and IGES files; ISO 8601 passes.
std::string stamp_of(const std::string& given) {
  const auto digits = [&](std::size_t from, std::size_t n) {
    return given.size() >= from + n && given.substr(from, n).find_first_not_of("0123456789") == std::string::npos;
  };
  if (given.size() == 15 && given[8] == '.' && digits(0, 8) && digits(9, 6)) {
    const auto part = [&](std::size_t from, std::size_t n) { return given.substr(from, n); };
    return fmt::format("{}-{}-{}T{}:{}:{}", part(0, 4), part(4, 2), part(6, 2), part(9, 2), part(11, 2), part(13, 2));
  }
  if (given.size() == 13 && given[6] == '.' && digits(0, 6) && digits(7, 6)) {  // IGES before 5.3: two digits of the year
    const auto part = [&](std::size_t from, std::size_t n) { return given.substr(from, n); };
    return fmt::format("{}{}-{}-{}T{}:{}:{}", part(0, 2) < "70" ? "20" : "19", part(0, 2), part(2, 2), part(4, 2), part(7, 2),
                       part(9, 2), part(11, 2));
  }
  if (given.size() >= 19 && given[4] == '-' && given[10] == 'T') return given;
  return std::string(null_stamp);
}

step::FileHeader header_of(const Model& model, const SourceInfo& source, const WriteOptions& options) {
  step::FileHeader h;
  h.description = "";
  h.name = model.name;
  h.time_stamp = stamp_of(options.timestamp);
  h.preprocessor = "trimloop";
  h.system = source.sender;
  h.schema = options.step_schema == StepSchema::Ap214
                 ? "AUTOMOTIVE_DESIGN { 1 0 10303 214 3 1 1 }"
                 : "AP242_MANAGED_MODEL_BASED_3D_ENGINEERING_MIM_LF { 1 0 10303 442 3 1 4 }";
  return h;
}

}  // namespace

Result<Exported> write(const Model& model, const SourceInfo& source, const WriteOptions& options) {
  const LengthUnit unit = options.unit.value_or(model.source_unit);
  EntityWriter writer(model, source.format, header_of(model, source, options), millimetres_per(unit), options.to_nurbs);
  const auto structure = structure_of(model, options.execution.limits.instances, writer.losses);
  if (!structure) return tl::unexpected(structure.error());
  if (structure->leaves_first.size() != structure->definitions.size()) {
    return fail(ErrorCode::InvalidArgument, "the assembly contains itself");
  }
  const SharedContext context = write_context(writer, unit, options.step_schema == StepSchema::Ap242);
  Targets targets;
  write_products(writer, *structure, context, targets);
  if (source.step && context.is_ap242) {
    targets.context = context.geometric;
    write_opaque(writer, *source.step, targets, options.execution.limits);
  }
  Exported out;
  auto bytes = writer.out.finish();
  if (!bytes) return tl::unexpected(bytes.error());
  out.bytes = std::move(*bytes);
  out.losses = std::move(writer.losses);
  out.nurbs = writer.statement;
  return out;
}

}  // namespace trimloop::io::step_export
