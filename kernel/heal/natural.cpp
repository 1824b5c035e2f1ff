// The boundary of the surface's own rectangle: a rectangle of border curves, with seams where it closes and poles
// where a side is a point.

#include "kernel/heal/draft.h"
#include "kernel/pcurve/isocurve.h"

namespace trimloop::heal {

Piece border_piece(const Sheet& sheet, Uv a, Uv b) {
  Piece p = straight_piece(a, b);
  const Point at = sheet.point(a);
  constexpr double rounding_mm = 1e-9;  // of the sine at a pole's latitude
  if (const Pole* pole = sheet.pole_at(a, at, rounding_mm); pole && pole == sheet.pole_at(b, sheet.point(b), rounding_mm)) {
    p.is_pole = true;
    return p;
  }
  const bool constant_u = a.u == b.u;
  if (!constant_u && a.v != b.v) return p;
  const double from = constant_u ? a.v : a.u, to = constant_u ? b.v : b.u;
  const bool covers = constant_u ? sheet.covers_u() : sheet.covers_v();
  const Uv home = sheet.home(a);
  const double value = covers ? (constant_u ? a.u : a.v) : (constant_u ? home.u : home.v);
  p.curve = pcurve::isocurve(sheet.surface(), constant_u, value, {std::min(from, to), std::max(from, to)});
  if (!p.curve) return p;
  p.c0 = from;
  p.c1 = to;
  for (int i = 0; i <= 8; ++i) {
    const double f = i / 8.0;
    const Point q = evaluate(*p.curve, Interval{from, to}.at(f));
    p.gap_mm = std::max(p.gap_mm, distance(q, sheet.point(a + f * (b - a))));
  }
  return p;
}

namespace {

// The four sides; nodes for the corners, one for both corners of a side that is a pole.
Ring rectangle(Draft& draft, Interval u, Interval v) {
  const Uv corners[] = {{u.lo, v.lo}, {u.hi, v.lo}, {u.hi, v.hi}, {u.lo, v.hi}};
  Ring ring;
  ring.is_joined = true;
  int nodes[4];
  for (int i = 0; i < 4; ++i) {
    ring.pieces.push_back(border_piece(draft.sheet, corners[i], corners[(i + 1) % 4]));
    nodes[i] = draft.add_node(draft.sheet.point(corners[i]));
  }
  for (int i = 0; i < 4; ++i)
    if (ring.pieces[static_cast<std::size_t>(i)].is_pole) {
      const int gone = nodes[(i + 1) % 4];
      for (int& node : nodes) node = node == gone ? nodes[i] : node;
    }
  for (int i = 0; i < 4; ++i) {
    ring.pieces[static_cast<std::size_t>(i)].start = nodes[i];
    ring.pieces[static_cast<std::size_t>(i)].end = nodes[(i + 1) % 4];
  }
  return ring;
}

// A sheet closed both ways: all four corners are one point, opposite sides one edge.
Ring cut_torus(Draft& draft, Interval u, Interval v) {
  Ring ring = rectangle(draft, u, v);
  for (std::size_t i = 0; i < 4; ++i) {
    Piece& p = ring.pieces[i];
    p.start = p.end = ring.pieces[0].start;
    p.seam = draft.seams + static_cast<int>(i % 2);
  }
  draft.seams += 2;
  return ring;
}

// The border v = value (or u = value) of a sheet that closes in the other direction: a ring that winds once.
void add_winding_border(Draft& draft, bool along_u, double value, Interval range, bool forward) {
  const double from = forward ? range.lo : range.hi, to = forward ? range.hi : range.lo;
  Ring ring;
  ring.pieces.push_back(along_u ? border_piece(draft.sheet, {from, value}, {to, value})
                                : border_piece(draft.sheet, {value, from}, {value, to}));
  Piece& p = ring.pieces.front();
  if (p.is_pole) return;
  p.start = p.end = draft.add_node(p.curve ? evaluate(*p.curve, p.c0) : draft.sheet.point(first_uv(p)));
  (along_u ? ring.turns_u : ring.turns_v) = forward ? 1 : -1;
  ring.is_joined = true;
  draft.rings.push_back(std::move(ring));
}

bool covers_period(Interval range, double period) { return period > 0 && range.length() >= period * (1 - 1e-9); }

}  // namespace

void add_natural_boundary(Draft& draft) {
  const Sheet& sheet = draft.sheet;
  const Interval u = draft.input.range_u.value_or(sheet.domain().u), v = draft.input.range_v.value_or(sheet.domain().v);
  if (!u.is_bounded() || !v.is_bounded() || !(u.lo < u.hi) || !(v.lo < v.hi)) {
    draft.failure = "the surface is unbounded and no loop bounds it";
    return;
  }
  const bool closed_u = covers_period(u, sheet.period_u()), closed_v = covers_period(v, sheet.period_v());
  if (closed_u && closed_v) {
    draft.rings.push_back(cut_torus(draft, u, v));
  } else if (closed_u) {
    draft.whole_u = true;
    add_winding_border(draft, true, v.lo, u, true);
    add_winding_border(draft, true, v.hi, u, false);
  } else if (closed_v) {
    draft.whole_v = true;
    add_winding_border(draft, false, u.lo, v, false);
    add_winding_border(draft, false, u.hi, v, true);
  } else {
    draft.rings.push_back(rectangle(draft, u, v));
  }
}

}  // namespace trimloop::heal
