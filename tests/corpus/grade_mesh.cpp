// Grades the mesh of one file: proven bounds against an independent dense measurement, triangle by triangle.
//
// usage: grade_mesh FILE DEFLECTION_MM [ANGLE_DEG=28.65 [prove]]   one line of JSON; exit 1 when a bound is broken
//
// Measured: 55 places of each triangle's piece of surface and a climb from the worst of them, each to the nearest of the
// triangle and two rings around it. It shares nothing with the mesher but the evaluation of surfaces.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <set>

#include "io/io.h"
#include "kernel/mesh/certify.h"
#include "kernel/mesh/tessellate.h"

using namespace trimloop;

namespace {

double distance_to_segment(Point p, Point a, Point b) {
  const Vector d = b - a;
  const double l = dot(d, d), s = l > 0 ? std::clamp(dot(p - a, d) / l, 0.0, 1.0) : 0.0;
  return distance(p, a + s * d);
}

double distance_to_triangle(Point p, const std::array<Point, 3>& t) {
  const Vector n = cross(t[1] - t[0], t[2] - t[0]), d = p - t[0];
  const double nn = dot(n, n);
  if (nn > 0) {
    const double w = dot(cross(t[1] - t[0], d), n) / nn, v = dot(cross(d, t[2] - t[0]), n) / nn;
    if (v >= 0 && w >= 0 && v + w <= 1) return std::abs(dot(d, n)) / std::sqrt(nn);
  }
  return std::min({distance_to_segment(p, t[0], t[1]), distance_to_segment(p, t[1], t[2]), distance_to_segment(p, t[2], t[0])});
}

class Measured {
 public:
  Measured(const Body& body, const mesh::BodyMesh& m, const mesh::FaceMesh& face)
      : surface_(*body[face.face].surface), face_(face), around_(m.points.size()) {
    for (std::size_t t = 0; t < face.triangles.size(); ++t) {
      std::array<Point, 3> c;
      for (std::size_t i = 0; i < 3; ++i) {
        around_[face.vertices[face.triangles[t][i]].point].push_back(t);
        c[i] = m.points[face.vertices[face.triangles[t][i]].point];
      }
      corners_.push_back(c);
    }
    for (const LoopId loop : body[face.face].loops)
      for (const Coedge& c : body[loop].coedges)
        if (body[c.edge].is_pole) {
          const Uv a = start_uv(body, c), b = end_uv(body, c);
          poles_.push_back({body[body[c.edge].start].point, std::abs(a.u - b.u) > std::abs(a.v - b.v)});
        }
  }

  double of(std::size_t t) {
    set_piece(t);
    near_.clear();
    constexpr int n = 9;
    double worst = 0, at_a = 0, at_b = 0;
    for (int i = 0; i <= n; ++i)
      for (int j = 0; i + j <= n; ++j) offer(t, i / double{n}, j / double{n}, worst, at_a, at_b);
    for (double step = 0.5 / n; step > 1e-3; step *= 0.5) {
      for (const auto& [da, db] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, -1}, {-1, 1}})
        offer(t, at_a + step * da, at_b + step * db, worst, at_a, at_b);
    }
    return worst;
  }

 private:
  struct Pole {
    Point point;
    bool along_u;
  };

  void set_piece(std::size_t t) {
    for (std::size_t i = 0; i < 3; ++i) uv_[i] = face_.vertices[face_.triangles[t][i]].uv;
    pole_ = -1;
    for (int i = 0; i < 3; ++i)
      for (const Pole& p : poles_)
        if (distance(corners_[t][static_cast<std::size_t>(i)], p.point) == 0) pole_ = i, along_u_ = p.along_u;
  }

  // A fan triangle stands for the strip between its far side and the pole's side.
  Uv place(double a, double b) const {
    const double l[3] = {a, b, 1 - a - b};
    Uv at = l[0] * uv_[0] + l[1] * uv_[1] + l[2] * uv_[2];
    if (pole_ < 0) return at;
    const auto i = static_cast<std::size_t>(pole_);
    const double rest = 1 - l[i];
    if (!(rest > 0)) return at;
    const Uv far = (1 / rest) * (at - l[i] * uv_[i]);
    (along_u_ ? at.u : at.v) = along_u_ ? far.u : far.v;
    return at;
  }

  void offer(std::size_t t, double a, double b, double& worst, double& at_a, double& at_b) {
    if (a < 0 || b < 0 || a + b > 1) return;
    const Point p = evaluate(surface_, place(a, b));
    double d = distance_to_triangle(p, corners_[t]);
    if (!(d > worst)) return;
    if (near_.empty()) rings(t);
    for (const std::size_t k : near_) d = std::min(d, distance_to_triangle(p, corners_[k]));
    if (d > worst) worst = d, at_a = a, at_b = b;
  }

  void rings(std::size_t t) {
    std::set<std::size_t> found{t};
    for (int ring = 0; ring < 2; ++ring) {
      const std::set<std::size_t> known = found;
      for (const std::size_t k : known)
        for (const std::uint32_t v : face_.triangles[k]) {
          const auto& here = around_[face_.vertices[v].point];
          found.insert(here.begin(), here.end());
        }
    }
    near_.assign(found.begin(), found.end());
  }

  const Surface& surface_;
  const mesh::FaceMesh& face_;
  std::vector<std::vector<std::size_t>> around_;
  std::vector<std::array<Point, 3>> corners_;
  std::vector<Pole> poles_;
  std::vector<std::size_t> near_;
  std::array<Uv, 3> uv_;
  int pole_ = -1;
  bool along_u_ = true;
};

struct Grade {
  std::size_t faces = 0, failed = 0, empty = 0, proven = 0, triangles = 0, judged = 0, broken = 0, over = 0, faces_over = 0, not_met = 0;
  std::size_t flipped = 0, degenerate = 0, duplicate = 0, closed_shells = 0, open_sides = 0;
  double worst = 0, worst_bound = 0, mesh_ms = 0, certify_ms = 0;
  std::vector<double> ratios;
};

double share(std::vector<double>& x, double q) {
  if (x.empty()) return 0;
  const auto k = static_cast<std::size_t>(q * static_cast<double>(x.size() - 1));
  std::nth_element(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(k), x.end());
  return x[k];
}

double milliseconds(std::chrono::steady_clock::time_point from) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - from).count();
}

void invariants(const Body& body, const mesh::BodyMesh& m, Grade& g) {
  for (const mesh::FaceMesh& face : m.faces) {
    std::set<std::array<std::uint32_t, 3>> seen;
    for (const auto& v : face.triangles) {
      std::array<std::uint32_t, 3> p;
      Vector normals;
      for (std::size_t i = 0; i < 3; ++i) p[i] = face.vertices[v[i]].point, normals += face.vertices[v[i]].normal;
      const Vector n = cross(m.points[p[1]] - m.points[p[0]], m.points[p[2]] - m.points[p[0]]);
      g.flipped += dot(n, normals) < 0;
      std::sort(p.begin(), p.end());
      g.degenerate += p[0] == p[1] || p[1] == p[2] || !(norm(n) > 0);
      g.duplicate += !seen.insert(p).second;
    }
  }
  for (const Shell& shell : body.shells) {
    if (!shell.closed) continue;
    ++g.closed_shells;
    std::vector<std::array<std::uint32_t, 2>> sides;
    for (const Shell::Use& use : shell.faces) {
      const mesh::FaceMesh& face = m.faces[use.face.index];
      for (const auto& v : face.triangles)
        for (std::size_t i = 0; i < 3; ++i) {
          const std::uint32_t a = face.vertices[v[i]].point, b = face.vertices[v[(i + 1) % 3]].point;
          sides.push_back({std::min(a, b), std::max(a, b)});
        }
    }
    std::sort(sides.begin(), sides.end());
    for (std::size_t i = 0, j = 0; i < sides.size(); i = j) {
      while (j < sides.size() && sides[j] == sides[i]) ++j;
      g.open_sides += j - i != 2;
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return std::fprintf(stderr, "usage: grade_mesh FILE DEFLECTION_MM [ANGLE_DEG]\n"), 2;
  mesh::TessellationOptions options;
  options.deflection_mm = std::atof(argv[2]);
  options.angle_rad = (argc > 3 ? std::atof(argv[3]) : 0.5 * 180 / pi) * pi / 180;
  options.prove = argc > 4;
  const io::ReadResult in = io::read(argv[1]);
  Grade g;
  const double eps = options.deflection_mm;
  for (const Part& part : in.model.parts) {
    for (const Body& body : part.bodies) {
      auto start = std::chrono::steady_clock::now();
      const auto m = mesh::tessellate(body, options);
      g.mesh_ms += milliseconds(start);
      if (!m) continue;
      start = std::chrono::steady_clock::now();
      const std::vector<mesh::FaceBounds> bounds = mesh::certify(body, *m, {0.01 * eps, 1.05, 8});
      g.certify_ms += milliseconds(start);
      invariants(body, *m, g);
      for (std::size_t f = 0; f < m->faces.size(); ++f) {
        const mesh::FaceMesh& face = m->faces[f];
        ++g.faces;
        const bool is_ok = body.faces[f].status == FaceStatus::Ok;
        if (body.faces[f].status == FaceStatus::Failed) ++g.failed;
        if (is_ok && face.triangles.empty()) ++g.empty;
        if (face.triangles.empty()) continue;
        g.proven += face.bound_kind == mesh::BoundKind::Proven;
        if (is_ok) g.worst_bound = std::max(g.worst_bound, face.bound_mm / eps), g.not_met += !face.deflection_met;
        Measured measured(body, *m, face);
        double worst = 0;
        for (std::size_t t = 0; t < face.triangles.size(); ++t) {
          const double d = measured.of(t);
          worst = std::max(worst, d);
          ++g.triangles;
          g.over += is_ok && d > eps * (1 + 1e-9);
          if (bounds[f].kind != mesh::BoundKind::Proven) continue;
          ++g.judged;
          g.broken += bounds[f].triangle[t] < d;
          if (d > 0.01 * eps) g.ratios.push_back(bounds[f].triangle[t] / d);
        }
        if (is_ok) g.worst = std::max(g.worst, worst / eps), g.faces_over += worst > eps * (1 + 1e-9);
      }
    }
  }
  std::printf("{\"faces\":%zu,\"failed\":%zu,\"ok_empty\":%zu,\"proven\":%zu,\"not_met\":%zu,\"triangles\":%zu,\"judged\":%zu,\"broken\":%zu,"
              "\"over\":%zu,\"faces_over\":%zu,\"worst\":%.4f,\"worst_bound\":%.4f,\"median\":%.4f,\"p99\":%.4f,\"flipped\":%zu,"
              "\"degenerate\":%zu,\"duplicate\":%zu,\"closed_shells\":%zu,\"open_sides\":%zu,\"mesh_ms\":%.3f,\"certify_ms\":%.3f}\n",
              g.faces, g.failed, g.empty, g.proven, g.not_met, g.triangles, g.judged, g.broken, g.over, g.faces_over, g.worst, g.worst_bound,
              share(g.ratios, 0.5), share(g.ratios, 0.99), g.flipped, g.degenerate, g.duplicate, g.closed_shells, g.open_sides, g.mesh_ms, g.certify_ms);
  return g.broken ? 1 : 0;
}
