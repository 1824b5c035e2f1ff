#include "kernel/check/mass.h"

#include <Eigen/Eigenvalues>

#include "kernel/check/extent.h"
#include "kernel/check/flux.h"
#include "kernel/math/gauss.h"

namespace trimloop {
namespace {

using detail::What;

// Measure, first and second moments about an origin, as they are added up.
struct Sums {
  double measure = 0, error = 0, moment_error = 0;
  Vector first;
  SecondMoments second;
};

Result<MassProperties> finished(const Sums& s, Point origin, const char* what) {
  if (!(std::abs(s.measure) > 0)) return fail(ErrorCode::Degenerate, what, s.measure, 0);
  MassProperties m;
  m.measure = s.measure;
  m.error = s.error;
  m.moment_error = s.moment_error;
  const Vector c = s.first / s.measure;
  m.centroid = origin + c;
  const SecondMoments& q = s.second;  // Steiner's theorem
  m.moments = {q.xx - s.measure * c.x * c.x, q.yy - s.measure * c.y * c.y, q.zz - s.measure * c.z * c.z,
               q.xy - s.measure * c.x * c.y, q.yz - s.measure * c.y * c.z, q.zx - s.measure * c.z * c.x};
  const SecondMoments& i = m.moments;
  m.inertia = {{{i.yy + i.zz, -i.xy, -i.zx}, {-i.xy, i.zz + i.xx, -i.yz}, {-i.zx, -i.yz, i.xx + i.yy}}};
  Eigen::Matrix3d tensor;
  for (int r = 0; r < 3; ++r)
    for (int k = 0; k < 3; ++k) tensor(r, k) = m.inertia[static_cast<std::size_t>(r)][static_cast<std::size_t>(k)];
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(tensor);
  for (int k = 0; k < 3; ++k) {
    m.principal[static_cast<std::size_t>(k)] = eigen.eigenvalues()(k);
    const Eigen::Vector3d v = eigen.eigenvectors().col(k);
    m.axes[static_cast<std::size_t>(k)] = {v(0), v(1), v(2)};
  }
  if (dot(cross(m.axes[0], m.axes[1]), m.axes[2]) < 0) m.axes[2] = -m.axes[2];
  return m;
}

struct Ask {  // the six second moments in order
  What first[3], second[6];
};
constexpr Ask of_volume{
    {What::MomentX, What::MomentY, What::MomentZ},
    {What::MomentXX, What::MomentYY, What::MomentZZ, What::MomentXY, What::MomentYZ, What::MomentZX}};
constexpr Ask of_area{{What::AreaX, What::AreaY, What::AreaZ},
                      {What::AreaXX, What::AreaYY, What::AreaZZ, What::AreaXY, What::AreaYZ, What::AreaZX}};

// First and second moments of one face; `scale` is measure times size, what the errors are judged by.
void add_moments(Sums& sums, const Body& body, FaceId face, const Ask& ask, Point origin, double sign, double relative,
                 double scale, double size) {
  const auto take = [&](What what, double scale_here) {
    return detail::face_integral(body, face, what, origin, relative, relative * scale_here);
  };
  double first[3], second[6];
  for (std::size_t k = 0; k < 3; ++k) first[k] = sign * take(ask.first[k], scale).value;
  double error = 0;
  for (std::size_t k = 0; k < 6; ++k) {
    const Measured m = take(ask.second[k], scale * size);
    second[k] = sign * m.value;
    error = std::max(error, m.error);
  }
  sums.first += Vector{first[0], first[1], first[2]};
  SecondMoments& q = sums.second;
  q.xx += second[0], q.yy += second[1], q.zz += second[2], q.xy += second[3], q.yz += second[4], q.zx += second[5];
  sums.moment_error += error;
}

}  // namespace

Result<MassProperties> mass_properties(const Body& body, ShellId id, double relative_error) {
  const auto whole = volume(body, id, relative_error);
  if (!whole) return tl::unexpected<Error>(whole.error());
  Box box;
  for (const Shell::Use& use : body[id].faces) detail::add_face(box, body, body[use.face], nullptr);
  const Point origin = midpoint(box.lo, box.hi);  // moments about the middle lose fewest digits
  const double size = box.diagonal();
  Sums sums;
  sums.measure = whole->value, sums.error = whole->error;
  for (const Shell::Use& use : body[id].faces) {
    const double sign = use.reversed != body[use.face].reversed ? -1 : 1;
    add_moments(sums, body, use.face, of_volume, origin, sign, relative_error, std::abs(whole->value) * size, size);
  }
  return finished(sums, origin, "a shell without volume has no centre");
}

Result<MassProperties> mass_properties(const Body& body, FaceId id, double relative_error) {
  const Measured whole = area(body, id, relative_error);
  Box box;
  detail::add_face(box, body, body[id], nullptr);
  const Point origin = box.empty() ? Point{} : midpoint(box.lo, box.hi);
  const double size = box.diagonal();
  Sums sums;
  sums.measure = whole.value, sums.error = whole.error;
  if (whole.value > 0) add_moments(sums, body, id, of_area, origin, 1, relative_error, whole.value * size, size);
  return finished(sums, origin, "a face without area has no centre");
}

Result<MassProperties> mass_properties(const Curve& c, double relative_error) {
  if (!is_bounded(c)) return fail(ErrorCode::InvalidArgument, "an unbounded curve has no centre");
  const Box box = bounding_box(c);
  const Point origin =
      box.empty() || !is_finite(box.lo) || !is_finite(box.hi) ? start_point(c) : midpoint(box.lo, box.hi);
  // Ten integrals at once on the same pieces, halved until Kronrod's and Gauss's sums agree.
  using Ten = std::array<double, 10>;
  const auto rule = [&](double lo, double hi, Ten& error) {
    Ten whole{}, inner{};
    const double mid = 0.5 * (lo + hi), half = 0.5 * (hi - lo);
    for (const KronrodNode& node : kronrod_15()) {
      const CurveJet j = jet(c, mid + half * node.x);
      const Vector r = j.point - origin;
      const double v = half * norm(j.d1);
      const Ten f{v,
                  v * r.x,
                  v * r.y,
                  v * r.z,
                  v * r.x * r.x,
                  v * r.y * r.y,
                  v * r.z * r.z,
                  v * r.x * r.y,
                  v * r.y * r.z,
                  v * r.z * r.x};
      for (std::size_t k = 0; k < 10; ++k) whole[k] += node.kronrod * f[k], inner[k] += node.gauss * f[k];
    }
    for (std::size_t k = 0; k < 10; ++k) error[k] = std::abs(whole[k] - inner[k]);
    return whole;
  };
  Sums sums;
  Ten total{}, off{};
  const double size = std::max(box.empty() ? 0 : box.diagonal(), 1e-300), rough = length(c, 1e-6);
  struct Stretch {
    double lo, hi;
    int depth;
  };
  std::vector<Stretch> open;
  const std::vector<double> at = breaks(c);
  for (std::size_t i = at.size() - 1; i > 0; --i)
    if (at[i - 1] < at[i]) open.push_back({at[i - 1], at[i], 0});
  while (!open.empty()) {
    const Stretch p = open.back();
    open.pop_back();
    Ten error;
    const Ten value = rule(p.lo, p.hi, error);
    // The difference of the rules is that of the smaller one: its square root's worth is enough (15 against 7 nodes).
    double worst = error[0] / rough;
    for (std::size_t k = 1; k < 10; ++k) worst = std::max(worst, error[k] / (rough * (k < 4 ? size : size * size)));
    if (worst > std::sqrt(relative_error) * 1e-2 && p.depth < 24) {
      const double mid = 0.5 * (p.lo + p.hi);
      open.push_back({mid, p.hi, p.depth + 1});
      open.push_back({p.lo, mid, p.depth + 1});
      continue;
    }
    for (std::size_t k = 0; k < 10; ++k) total[k] += value[k], off[k] += error[k] * worst;
  }
  sums.measure = total[0], sums.error = off[0];
  sums.first = {total[1], total[2], total[3]};
  sums.second = {total[4], total[5], total[6], total[7], total[8], total[9]};
  sums.moment_error = *std::max_element(off.begin() + 4, off.end());
  return finished(sums, origin, "a curve without length has no centre");
}

}  // namespace trimloop
