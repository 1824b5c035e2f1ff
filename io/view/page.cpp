#include "io/view/page.h"

#include <fmt/format.h>

#include <cstring>
#include <iterator>

#include "base/bytes.h"
#include "base/number.h"
#include "io/face_report.h"
#include "io/shape_words.h"

namespace trimloop::io {

namespace {

// JSON text that is also safe inside a <script> element: '<' never appears as itself.
std::string json_text(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (byte < 0x20 || byte >= 0x7f || c == '<' || c == '>' || c == '&') {
      out += fmt::format("\\u{:04x}", byte);
    } else {
      out += c;
    }
  }
  out += '"';
  return out;
}

std::string html_text(std::string_view text) {
  std::string out;
  for (const char c : printable(text, 300)) {
    if (c == '<') out += "&lt;";
    else if (c == '>') out += "&gt;";
    else if (c == '&') out += "&amp;";
    else if (c == '"') out += "&quot;";
    else out += c;
  }
  return out;
}

template <class T>
std::string base64(const std::vector<T>& values) {
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto* bytes = reinterpret_cast<const unsigned char*>(values.data());
  const std::size_t n = values.size() * sizeof(T);
  std::string out;
  out.reserve((n + 2) / 3 * 4);
  for (std::size_t i = 0; i < n; i += 3) {
    const unsigned a = bytes[i], b = i + 1 < n ? bytes[i + 1] : 0u, c = i + 2 < n ? bytes[i + 2] : 0u;
    out += digits[a >> 2];
    out += digits[(a & 3) << 4 | b >> 4];
    out += i + 1 < n ? digits[(b & 15) << 2 | c >> 6] : '=';
    out += i + 2 < n ? digits[c & 63] : '=';
  }
  return out;
}

void push(std::vector<float>& out, Vector v) {
  out.push_back(static_cast<float>(v.x));
  out.push_back(static_cast<float>(v.y));
  out.push_back(static_cast<float>(v.z));
}

// Where each edge was sampled, by edge index; poles and unused edges have none.
std::vector<const mesh::EdgePolyline*> polylines_by_edge(const Body& body, const mesh::BodyMesh& mesh) {
  std::vector<const mesh::EdgePolyline*> out(body.edges.size(), nullptr);
  for (const mesh::EdgePolyline& line : mesh.edges) out[line.edge.index] = &line;
  return out;
}

// The loops of a face as closed polylines in (u, v), at the parameters where its edges were sampled.
std::string loops_json(const Body& body, const std::vector<const mesh::EdgePolyline*>& sampled, const Face& face) {
  std::string out;
  for (const LoopId id : face.loops) {
    std::string loop;
    for (const Coedge& coedge : body[id].coedges) {
      const Edge& edge = body[coedge.edge];
      const mesh::EdgePolyline* line = sampled[coedge.edge.index];
      const std::vector<double> ts = line ? line->parameters : std::vector<double>{edge.range.lo, edge.range.hi};
      for (std::size_t k = 0; k + 1 < ts.size(); ++k) {
        const Uv p = uv_at(body, coedge, ts[coedge.reversed ? ts.size() - 1 - k : k]);
        loop += fmt::format("{}{},{}", loop.empty() ? "" : ",", json_real(p.u), json_real(p.v));
      }
    }
    out += fmt::format("{}[{}]", out.empty() ? "" : ",", loop);
  }
  return out;
}

// Area before and after in mm2 of a healed face, else nothing.
std::string areas_json(const Body& body, std::size_t f) {
  const FaceReport row = face_report({}, body, FaceId{static_cast<std::uint32_t>(f)}, 0);
  if (row.area_mm2 < 0) return "[]";
  return fmt::format("[{},{}]", row.area_before_mm2 < 0 ? "null" : json_real(row.area_before_mm2), json_real(row.area_mm2));
}

struct Centre {
  Point at;
  double size = 1;
};

// Every visible annotation of every occurrence.
template <class Visit>
void for_each_annotation(const Model& model, const Scene& scene, Visit visit) {
  for (const Occurrence& o : scene.occurrences)
    for (const Annotation& a : model.parts[o.part].annotation)
      if (is_visible(model, a.attributes)) visit(a, o.transform);
}

Centre centre_of(const Model& model, const Scene& scene) {
  Box box;
  for (const Occurrence& o : scene.occurrences) {
    for (const SceneBody& item : scene.bodies) {
      if (item.part != o.part) continue;
      for (const Point& p : item.mesh.points) box.add(apply(o.transform, p));
    }
  }
  for_each_annotation(model, scene, [&](const Annotation& a, const Transform& t) {
    for (const auto& stroke : a.strokes)
      for (const Point& p : stroke) box.add(apply(t, p));
    for (const TextRun& run : a.texts) {
      box.add(apply(t, run.origin));
      box.add(apply(t, run.origin + run.along + run.up));
    }
  });
  if (box.empty()) return {};
  return {midpoint(box.lo, box.hi), box.diagonal()};
}

std::string vector_json(Vector v) { return fmt::format("[{},{},{}]", json_real(v.x), json_real(v.y), json_real(v.z)); }

// Strokes as pairs of points, texts as runs; once per occurrence, about the centre of the page.
std::string annotation_json(const Model& model, const SourceInfo& source, const Scene& scene, Point centre) {
  std::string out;
  for_each_annotation(model, scene, [&](const Annotation& a, const Transform& t) {
    std::vector<float> strokes;
    for (const auto& stroke : a.strokes)
      for (std::size_t i = 0; i + 1 < stroke.size(); ++i) {
        push(strokes, apply(t, stroke[i]) - centre);
        push(strokes, apply(t, stroke[i + 1]) - centre);
      }
    std::string texts;
    for (const TextRun& run : a.texts)
      texts += fmt::format("{}{{\"text\":{},\"at\":{},\"along\":{},\"up\":{}}}", texts.empty() ? "" : ",", json_text(run.text),
                           vector_json(apply(t, run.origin) - centre), vector_json(apply(t, run.along)),
                           vector_json(apply(t, run.up)));
    const Colour colour = model[a.attributes].colour.value_or(Colour{0.1, 0.25, 0.5});
    out += fmt::format("{}{{\"kind\":{},\"source\":{},\"colour\":[{},{},{}],\"strokes\":\"{}\",\"texts\":[{}]}}",
                       out.empty() ? "" : ",", json_text(a.kind),
                       json_text(a.source.empty() ? std::string() : source_name(source.format, a.source.front())), colour.r,
                       colour.g, colour.b, base64(strokes), texts);
  });
  return out;
}

// What the page says of one face beside its triangles.
struct FaceWords {
  std::string source, surface, status, reason, areas, loops;
};

FaceWords words_of(const SourceInfo& source, const Body& body, const std::vector<const mesh::EdgePolyline*>& sampled, std::size_t f) {
  const Face& face = body.faces[f];
  FaceWords out;
  if (!face.source.empty()) out.source = source_name(source.format, face.source.front());
  out.surface = face.surface ? shape_word(*face.surface) : "none";
  out.status = face.status == FaceStatus::Ok ? "ok" : face.status == FaceStatus::Healed ? "healed" : "failed";
  out.reason = face.reason;
  out.areas = areas_json(body, f);
  out.loops = loops_json(body, sampled, face);
  return out;
}

FaceWords words_of(const SourceInfo& source, const MeshFace& face) {
  return {face.source.empty() ? std::string() : source_name(source.format, face.source.front()), "triangles", "ok", {}, "[]", {}};
}

std::string placements_json(const Scene& scene, std::uint32_t part, Point own_centre, Point centre) {
  std::string out;
  for (const Occurrence& o : scene.occurrences) {
    if (o.part != part) continue;
    const Transform t = Transform::translation(to_vector(centre) * -1) * o.transform *
                        Transform::translation(to_vector(own_centre));
    out += fmt::format("{}[{},{},{},0,{},{},{},0,{},{},{},0,{},{},{},1]", out.empty() ? "" : ",", t.r[0][0],
                              t.r[1][0], t.r[2][0], t.r[0][1], t.r[1][1], t.r[2][1], t.r[0][2], t.r[1][2], t.r[2][2],
                              t.t.x, t.t.y, t.t.z);
  }
  return out;
}

std::string body_json(const Model& model, const SourceInfo& source, const Scene& scene, std::size_t index, Point centre,
                      std::uint32_t& next_id) {
  const SceneBody& item = scene.bodies[index];
  const Part& part = model.parts[item.part];
  const Body* body = item.is_given ? nullptr : &part.bodies[item.body];
  Box box;
  for (const Point& p : item.mesh.points) box.add(p);
  const Point own_centre = box.empty() ? Point{} : midpoint(box.lo, box.hi);

  std::vector<float> positions, normals, edges;
  std::vector<std::uint32_t> triangles;
  std::string faces;
  const auto sampled = body ? polylines_by_edge(*body, item.mesh) : std::vector<const mesh::EdgePolyline*>{};
  const Attributes& all = model[attributes_of(model, item)];
  for (std::size_t f = 0; f < item.mesh.faces.size(); ++f) {
    const mesh::FaceMesh& m = item.mesh.faces[f];
    const FaceWords words = body ? words_of(source, *body, sampled, f) : words_of(source, part.meshes[item.body].faces[f]);
    const Attributes& own = model[attributes_of(model, item, m)];
    const Colour colour = own.colour ? *own.colour : all.colour ? *all.colour : Colour{0.72, 0.75, 0.8};
    const auto first_vertex = static_cast<std::uint32_t>(positions.size() / 3);
    for (const mesh::FaceVertex& v : m.vertices) {
      push(positions, item.mesh.points[v.point] - own_centre);
      push(normals, v.normal);
    }
    faces += fmt::format(
        "{}{{\"id\":{},\"source\":{},\"name\":{},\"surface\":\"{}\",\"status\":\"{}\",\"reason\":{},\"colour\":[{},{},{}],"
        "\"first_vertex\":{},\"vertices\":{},\"first_triangle\":{},\"triangles\":{},\"bound\":{},\"areas\":{},\"loops\":[{}]}}",
        f ? "," : "", next_id++, json_text(words.source), json_text(own.name), words.surface, words.status,
        json_text(!words.reason.empty() ? words.reason : m.reason), colour.r, colour.g, colour.b, first_vertex,
        m.vertices.size(), triangles.size() / 3, m.triangles.size(), json_real(m.bound_mm), words.areas, words.loops);
    for (const auto& t : m.triangles) {
      for (const std::uint32_t k : t) triangles.push_back(first_vertex + k);
    }
  }
  for (const mesh::EdgePolyline& edge : item.mesh.edges) {
    for (std::size_t k = 0; k + 1 < edge.points.size(); ++k) {
      push(edges, item.mesh.points[edge.points[k]] - own_centre);
      push(edges, item.mesh.points[edge.points[k + 1]] - own_centre);
    }
  }
  const std::string name = all.name.empty() ? fmt::format("{} {}", part.name.empty() ? body ? "Body" : "Mesh" : part.name, item.body + 1)
                                            : all.name;
  return fmt::format(
      "{{\"name\":{},\"placements\":[{}],\"positions\":\"{}\",\"normals\":\"{}\",\"triangles\":\"{}\",\"edges\":\"{}\","
      "\"faces\":[{}]}}",
      json_text(name), placements_json(scene, item.part, own_centre, centre), base64(positions), base64(normals), base64(triangles),
      base64(edges), faces);
}

constexpr std::string_view style = R"(
:root{font:14px/1.45 system-ui,sans-serif;color:#1d222b}body{margin:0;display:grid;grid-template:auto 1fr/16rem 1fr 18rem;height:100vh}
header{grid-column:1/-1;padding:.5rem 1rem;background:#1d222b;color:#fff;display:flex;gap:1.2rem;align-items:baseline}
header h1{font-size:1rem;margin:0}header span{opacity:.8}nav,aside{overflow:auto;padding:.75rem 1rem;background:#fff}
main{position:relative;min-width:0;min-height:0}canvas{position:absolute;inset:0;width:100%;height:100%;display:block}
ul{list-style:none;margin:.2rem 0 .6rem;padding:0}li{padding:.1rem .5rem;cursor:pointer;border-radius:4px}li:hover,li:focus{background:#eef1f6}
li[aria-selected]{background:#ffdcb8}li.healed{color:#8a5a00}li.failed{color:#b3261e}summary{cursor:pointer;font-weight:600}
h2{font-size:1rem}h3{font-size:.9rem;margin-bottom:.3rem}dl{display:grid;grid-template-columns:auto 1fr;gap:.15rem .8rem;margin:0}
dt{color:#5d6675}dd{margin:0;overflow-wrap:anywhere}figure{margin:0}figcaption{font-size:.8rem;color:#5d6675}svg{width:100%;background:#f4f5f7}
path{fill:none;stroke-width:1.6}path.outer{stroke:#1a5fb4;fill:#1a5fb41c}path.hole{stroke:#c01c28;fill:#f4f5f7}
@media(max-width:760px){body{grid-template:auto 3fr 2fr/1fr 1fr}header{flex-wrap:wrap;gap:0 1.2rem}main{grid-area:2/1/3/3}nav,aside{grid-row:3}})";

}  // namespace

Result<std::string> to_page(const Model& model, const SourceInfo& source, const Scene& scene, std::string_view script) {
  const Centre centre = centre_of(model, scene);
  std::string bodies;
  std::uint32_t next_id = 0;
  std::size_t triangles = 0, faces = 0;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    bodies += fmt::format("{}{}", bodies.empty() ? "" : ",", body_json(model, source, scene, i, centre.at, next_id));
    triangles += scene.bodies[i].mesh.triangle_count();
    faces += scene.bodies[i].mesh.faces.size();
  }
  const std::string title = html_text(source.name);
  std::string page = fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{}</title>\n"
      "<meta name=\"viewport\" content=\"width=device-width\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src 'unsafe-inline'; "
      "style-src 'unsafe-inline'; img-src data:\">\n<style>{}</style></head>\n<body>\n",
      title, style);
  page += fmt::format(
      "<header><h1>{}</h1><span>{} {}</span><span>{} faces</span><span>{} triangles within {:.3g} mm</span></header>\n"
      "<nav id=\"tree\" aria-label=\"Bodies and faces\"></nav>\n"
      "<main><canvas id=\"canvas\"></canvas><noscript><p>The picture needs JavaScript; `trimloop info` says the rest.</p></noscript></main>\n"
      "<aside id=\"picked\" aria-live=\"polite\"></aside>\n",
      title, to_string(source.format), html_text(source.version), faces, triangles, scene.deflection_mm);
  page += fmt::format("<script id=\"scene\" type=\"application/json\">{{\"size\":{},\"bodies\":[{}],\"annotation\":[{}]}}</script>\n",
                      json_real(centre.size), bodies, annotation_json(model, source, scene, centre.at));
  page += "<script>";
  page += script;
  page += "</script>\n</body></html>\n";
  return page;
}

}  // namespace trimloop::io
