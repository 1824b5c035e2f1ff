#include "kernel/batch/batch.h"

#include "base/assert.h"
#include "kernel/batch/access.h"
#include "kernel/batch/dispatch.h"

namespace trimloop {

namespace {

using batch::Kernels;

// Columns as the kernels take them, and the highest derivative wanted.
template <std::size_t Count>
struct Target {
  std::array<double*, Count> column{};
  std::size_t order = 0;
  std::size_t used() const { return Count == batch::curve_columns ? 3 * (order + 1) : order == 0 ? 3 : order * 9; }
  std::array<double*, Count> from(std::size_t at) const {
    std::array<double*, Count> out{};
    for (std::size_t c = 0; c < used(); ++c) out[c] = column[c] + at;
    return out;
  }
};
using SurfaceTarget = Target<batch::surface_columns>;
using CurveTarget = Target<batch::curve_columns>;

SurfaceTarget target_of(const SurfaceColumns& to) {
  SurfaceTarget t;
  std::size_t at = 0;
  for (const auto& group : {to.point, to.du, to.dv, to.duu, to.duv, to.dvv})
    for (double* column : group) t.column[at++] = column;
  t.order = to.duu[0] ? 2 : to.du[0] ? 1 : 0;
  for (std::size_t c = 0; c < t.used(); ++c) TRIMLOOP_ASSERT(t.column[c], "columns are given in whole groups");
  return t;
}
CurveTarget target_of(const CurveColumns& to) {
  CurveTarget t;
  std::size_t at = 0;
  for (const auto& group : {to.point, to.d1, to.d2})
    for (double* column : group) t.column[at++] = column;
  t.order = to.d2[0] ? 2 : to.d1[0] ? 1 : 0;
  for (std::size_t c = 0; c < t.used(); ++c) TRIMLOOP_ASSERT(t.column[c], "columns are given in whole groups");
  return t;
}

// Points are taken in blocks whose results stay in the second-level cache while they are put in their order.
constexpr std::size_t block_size = 4096;
using Ids = std::array<std::uint32_t, block_size>;

template <class Body>  // body(first, end) for each run of equal ids
void for_runs(const std::uint32_t* id, std::size_t n, Body body) {
  for (std::size_t first = 0, end = 0; first < n; first = end) {
    for (end = first + 1; end < n && id[end] == id[first];) ++end;
    body(first, end);
  }
}

// The workspace of one call. Sorted runs are evaluated in whole vectors: beyond its end a run spoils what the next one
// writes anyway, and behind the last there is room.
constexpr std::size_t slack = 8, row_size = block_size + slack;
struct Workspace {
  Ids id, id_v, rank, sorted_id;
  std::array<double, row_size> sorted_u{}, sorted_v{};
  std::vector<std::uint32_t> start;
  std::vector<double> results;
};

// Evaluates n points in the order of their ids, by a counting sort. run(id, u, v, n, columns).
template <std::size_t Count, class Evaluate>
void evaluate_sorted(Workspace& w, std::size_t n, std::size_t ids, const double* u, const double* v, std::size_t lanes,
                     const Target<Count>& to, Evaluate run) {
  w.start.assign(ids + 1, 0);
  for (std::size_t k = 0; k < n; ++k) ++w.start[w.id[k] + 1];
  for (std::size_t i = 1; i <= ids; ++i) w.start[i] += w.start[i - 1];
  for (std::size_t k = 0; k < n; ++k) {
    const std::uint32_t rank = w.start[w.id[k]]++;
    w.rank[k] = rank;
    w.sorted_u[rank] = u[k];
    w.sorted_v[rank] = v[k];
    w.sorted_id[rank] = w.id[k];
  }
  w.results.resize(to.used() * row_size);
  for_runs(w.sorted_id.data(), n, [&](std::size_t first, std::size_t end) {
    std::array<double*, Count> columns;
    for (std::size_t c = 0; c < to.used(); ++c) columns[c] = w.results.data() + c * row_size + first;
    const std::size_t whole = (end - first + lanes - 1) / lanes * lanes;
    run(w.sorted_id[first], w.sorted_u.data() + first, w.sorted_v.data() + first, whole, columns.data());
  });
  for (std::size_t c = 0; c < to.used(); ++c) {
    const double* from = w.results.data() + c * row_size;
    for (std::size_t k = 0; k < n; ++k) to.column[c][k] = from[w.rank[k]];
  }
}

// As the span for comparison: the outer ones reach to infinity, the last one with its end.
batch::Span reach(const Spans& s, std::size_t i) {
  return {i == 0 ? -infinity : s[i].lo, i + 1 == s.size() ? infinity : s[i].hi, 0};
}

// Points come in runs of one id, or are sorted block by block. id_of(k) of a point; prefix(id, k) the length of the
// run from k on; ids(k, n) fills w.id.
template <std::size_t Count, class IdOf, class Prefix, class IdsOf, class Evaluate>
void evaluate_all(std::span<const double> u, std::span<const double> v, std::size_t ids, std::size_t lanes,
                  Target<Count> target, Workspace& w, IdOf id_of, Prefix prefix, IdsOf fill_ids, Evaluate run) {
  constexpr std::size_t worth_it = 32;
  for (std::size_t at = 0; at < u.size();) {
    const std::size_t left = u.size() - at;
    const std::uint32_t id = id_of(at);
    std::size_t n = prefix(id, at);
    if (n >= worth_it || left < worth_it) {
      n = std::max<std::size_t>(n, 1);  // NaN is in no span
      run(id, u.data() + at, v.data() + at, n, target.column.data());
    } else {
      n = std::min(block_size, left);
      fill_ids(at, n);
      evaluate_sorted(w, n, ids, u.data() + at, v.data() + at, lanes, target, run);
    }
    at += n;
    target.column = target.from(n);
  }
}

}  // namespace

void evaluate(const SurfacePieces& s, std::span<const double> u, std::span<const double> v, const SurfaceColumns& to,
              BatchOptions options) {
  TRIMLOOP_ASSERT(u.size() == v.size(), "a point has a u and a v");
  const Kernels& kernel = batch::kernels(options);
  const SurfaceTarget target = target_of(to);
  const batch::SpanTable in_u = BatchAccess::table(s.spans_u()), in_v = BatchAccess::table(s.spans_v());
  const auto w = std::make_unique<Workspace>();
  evaluate_all(
      u, v, s.size(), kernel.lanes, target, *w,
      [&](std::size_t k) {
        return static_cast<std::uint32_t>(s.spans_u().locate(u[k]) * in_v.spans + s.spans_v().locate(v[k]));
      },
      [&](std::uint32_t id, std::size_t k) {
        return kernel.prefix(reach(s.spans_u(), id / in_v.spans), reach(s.spans_v(), id % in_v.spans), u.data() + k,
                             v.data() + k, u.size() - k);
      },
      [&](std::size_t at, std::size_t n) {
        kernel.locate(in_u, u.data() + at, n, w->id.data());
        kernel.locate(in_v, v.data() + at, n, w->id_v.data());
        for (std::size_t k = 0; k < n; ++k) w->id[k] = w->id[k] * in_v.spans + w->id_v[k];
      },
      [&](std::uint32_t id, const double* pu, const double* pv, std::size_t n, double* const* columns) {
        const batch::Patch patch = BatchAccess::patch(s, id / in_v.spans, id % in_v.spans);
        kernel.points[target.order](patch, pu, pv, n, columns);
      });
}

void evaluate(const CurvePieces& c, std::span<const double> t, const CurveColumns& to, BatchOptions options) {
  const Kernels& kernel = batch::kernels(options);
  const CurveTarget target = target_of(to);
  const batch::SpanTable table = BatchAccess::table(c.spans());
  const auto w = std::make_unique<Workspace>();
  evaluate_all(
      t, t, c.size(), kernel.lanes, target, *w,
      [&](std::size_t k) { return static_cast<std::uint32_t>(c.spans().locate(t[k])); },
      [&](std::uint32_t id, std::size_t k) {
        const batch::Span span = reach(c.spans(), id);
        return kernel.prefix(span, span, t.data() + k, t.data() + k, t.size() - k);
      },
      [&](std::size_t at, std::size_t n) { kernel.locate(table, t.data() + at, n, w->id.data()); },
      [&](std::uint32_t id, const double* at, const double*, std::size_t n, double* const* columns) {
        kernel.curve[target.order](BatchAccess::piece(c, id), at, n, columns);
      });
}

SurfaceGrid::Axis SurfaceGrid::located(const Spans& spans, std::span<const double> t) const {
  Axis a{std::vector<std::uint32_t>(t.size()), std::vector<double>(t.size()), {0}};
  batch::kernels(options_).locate(BatchAccess::table(spans), t.data(), t.size(), a.span.data());
  for (std::size_t k = 0; k < t.size(); ++k) a.local[k] = spans.local(a.span[k], t[k]);
  for_runs(a.span.data(), t.size(), [&](std::size_t, std::size_t end) { a.runs.push_back(end); });
  return a;
}

SurfaceGrid::SurfaceGrid(const SurfacePieces& s, std::span<const double> u, std::span<const double> v,
                         BatchOptions options)
    : pieces_(&s), options_(options), u_(located(s.spans_u(), u)), v_(located(s.spans_v(), v)) {}

void SurfaceGrid::rows(std::size_t first, std::size_t count, const SurfaceColumns& to) const {
  TRIMLOOP_ASSERT(first + count <= v_.span.size(), "the rows are among those of the grid");
  const Kernels& kernel = batch::kernels(options_);
  const SurfaceTarget target = target_of(to);
  const std::size_t n = u_.span.size();
  for (std::size_t j = first; j < first + count; ++j)
    for (std::size_t r = 0; r + 1 < u_.runs.size(); ++r) {
      const std::size_t i = u_.runs[r], end = u_.runs[r + 1];
      const batch::Patch patch = BatchAccess::patch(*pieces_, u_.span[i], v_.span[j]);
      std::array<double*, batch::surface_columns> columns;
      for (std::size_t c = 0; c < target.used(); ++c) columns[c] = target.column[c] + (j - first) * n + i;
      kernel.row[target.order](patch, v_.local[j], u_.local.data() + i, end - i, columns.data());
    }
}

void evaluate_grid(const SurfacePieces& s, std::span<const double> u, std::span<const double> v,
                   const SurfaceColumns& to, BatchOptions options) {
  SurfaceGrid(s, u, v, options).rows(0, v.size(), to);
}

namespace {

constexpr BatchOptions four_lanes{Arithmetic::SameBits, InstructionSet::Avx2};  // one point has no use for more

void single(const SurfacePieces& s, Uv uv, std::size_t order, double* numbers) {
  const batch::Patch patch = BatchAccess::patch(s, s.spans_u().locate(uv.u), s.spans_v().locate(uv.v));
  batch::kernels(four_lanes).point[order](patch, uv.u, uv.v, numbers);
}
Vector vector_at(const double* n, std::size_t group) { return {n[3 * group], n[3 * group + 1], n[3 * group + 2]}; }

}  // namespace

Point evaluate(const SurfacePieces& s, Uv uv) {
  double n[3];
  single(s, uv, 0, n);
  return {n[0], n[1], n[2]};
}

void jet1(const SurfacePieces& s, Uv uv, Point& point, Vector& du, Vector& dv) {
  double n[9];
  single(s, uv, 1, n);
  point = to_point(vector_at(n, 0));
  du = vector_at(n, 1);
  dv = vector_at(n, 2);
}

SurfaceJet jet(const SurfacePieces& s, Uv uv) {
  double n[18];
  single(s, uv, 2, n);
  return {to_point(vector_at(n, 0)), vector_at(n, 1), vector_at(n, 2),
          vector_at(n, 3),           vector_at(n, 4), vector_at(n, 5)};
}

CurveJet jet(const CurvePieces& c, double t) {
  double n[9];
  std::array<double*, batch::curve_columns> columns{};
  for (std::size_t i = 0; i < 9; ++i) columns[i] = n + i;
  batch::kernels(four_lanes).curve[2](BatchAccess::piece(c, c.spans().locate(t)), &t, 1, columns.data());
  return {to_point(vector_at(n, 0)), vector_at(n, 1), vector_at(n, 2)};
}

}  // namespace trimloop
