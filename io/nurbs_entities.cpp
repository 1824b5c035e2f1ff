#include "io/nurbs_entities.h"

#include "io/shape_words.h"
#include "kernel/topology/parameter_box.h"

namespace trimloop::io {

namespace {

template <class Converted>
void set_form(NurbsEntity& row, const Result<Converted>& nurbs) {
  if (!nurbs) {
    row.form = NurbsEntity::Form::Kept;
    row.reason = nurbs.error().text;
  } else if (nurbs->deviation > 0) {
    row.form = NurbsEntity::Form::Near;
    row.deviation_mm = nurbs->deviation;
  }
}

NurbsEntity named(const SourceRefs& refs, const SourceInfo& source, std::string_view shape) {
  NurbsEntity row;
  if (!refs.empty()) row.source = source_name(source.format, refs.front());
  row.shape = shape;
  return row;
}

NurbsEntity of_curve(const FreeCurve& free, const SourceInfo& source) {
  NurbsEntity row = named(free.source, source, shape_word(free.curve));
  if (is_bounded(free.curve)) {
    set_form(row, to_nurbs(free.curve));
  } else {
    row.form = NurbsEntity::Form::Kept;
    row.reason = "a curve without end";
  }
  return row;
}

NurbsEntity of_face(const Body& body, const Face& face, const SourceInfo& source) {
  NurbsEntity row = named(face.source, source, shape_word(*face.surface));
  row.is_surface = true;
  const ParameterBox box = parameter_box(body, face);
  set_form(row, to_nurbs(*face.surface, box.u, box.v));
  for (const LoopId loop : face.loops) {
    for (const Coedge& coedge : body[loop].coedges) {
      const Edge& edge = body[coedge.edge];
      if (edge.is_pole || !edge.curve) continue;
      ++row.edges;
      NurbsEntity own;
      set_form(own, to_nurbs(*edge.curve));
      if (own.form == NurbsEntity::Form::Kept) ++row.edges_kept;
      if (own.form == NurbsEntity::Form::Near && row.form == NurbsEntity::Form::Exact) row.form = own.form;
      row.deviation_mm = std::max(row.deviation_mm, own.deviation_mm);
    }
  }
  return row;
}

}  // namespace

std::vector<NurbsEntity> nurbs_entities(const Model& model, const SourceInfo& source) {
  std::vector<NurbsEntity> out;
  for (const Part& part : model.parts) {
    for (const Body& body : part.bodies) {
      for (const Face& face : body.faces)
        if (face.surface && face.status != FaceStatus::Failed) out.push_back(of_face(body, face, source));
    }
    for (const FreeCurve& free : part.curves) out.push_back(of_curve(free, source));
  }
  return out;
}

}  // namespace trimloop::io
