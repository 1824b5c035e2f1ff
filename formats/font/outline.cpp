#include "formats/font/outline.h"

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include <fmt/format.h>

#include <memory>

namespace trimloop::font {

namespace {

// Receives FreeType's events and moves them by the pen.
struct Sink {
  std::vector<Segment>& path;
  double x = 0;

  std::array<double, 2> at(const FT_Vector* v) const { return {x + static_cast<double>(v->x), static_cast<double>(v->y)}; }
  void put(Segment::Kind kind, std::initializer_list<const FT_Vector*> points) {
    Segment s;
    s.kind = kind;
    std::size_t i = 0;
    for (const FT_Vector* p : points) s.at[i++] = at(p);
    path.push_back(s);
  }
  void close() {
    if (path.empty() || path.back().kind == Segment::Kind::Close) return;
    Segment s;
    s.kind = Segment::Kind::Close;
    path.push_back(s);
  }
};

int move_to(const FT_Vector* to, void* user) {
  Sink& sink = *static_cast<Sink*>(user);
  sink.close();
  sink.put(Segment::Kind::Move, {to});
  return 0;
}
int line_to(const FT_Vector* to, void* user) {
  static_cast<Sink*>(user)->put(Segment::Kind::Line, {to});
  return 0;
}
int conic_to(const FT_Vector* by, const FT_Vector* to, void* user) {
  static_cast<Sink*>(user)->put(Segment::Kind::Quad, {by, to});
  return 0;
}
int cubic_to(const FT_Vector* a, const FT_Vector* b, const FT_Vector* to, void* user) {
  static_cast<Sink*>(user)->put(Segment::Kind::Cubic, {a, b, to});
  return 0;
}

// Code points of UTF-8; a byte that fits nowhere stands for U+FFFD.
std::u32string decoded(std::string_view text) {
  std::u32string out;
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
    const unsigned char lead = byte(i);
    const std::size_t more = lead < 0x80 ? 0 : lead >= 0xF0 ? 3 : lead >= 0xE0 ? 2 : lead >= 0xC2 ? 1 : 4;
    char32_t c = more == 0 ? lead : static_cast<char32_t>(lead & (0x3F >> more));
    std::size_t k = 1;
    while (k <= more && more < 4 && i + k < text.size() && (byte(i + k) & 0xC0) == 0x80) c = (c << 6) | (byte(i + k) & 0x3F), ++k;
    const bool good = more < 4 && k == more + 1;
    out.push_back(good ? c : U'\uFFFD');
    i += good ? k : 1;
  }
  return out;
}

struct Library {
  FT_Library handle = nullptr;
  FT_Face face = nullptr;
  ~Library() {
    if (face) FT_Done_Face(face);
    if (handle) FT_Done_FreeType(handle);
  }
};

}  // namespace

bool sniff(std::string_view head) {
  using namespace std::string_view_literals;
  for (const std::string_view magic : {"\0\1\0\0"sv, "OTTO"sv, "true"sv, "ttcf"sv, "wOFF"sv, "%!PS-AdobeFont"sv})
    if (head.substr(0, magic.size()) == magic) return true;
  return false;
}

Result<Line> outline(std::string_view font_bytes, std::string_view text) {
  Library library;
  if (FT_Init_FreeType(&library.handle) != 0) return fail(ErrorCode::Unsupported, "FreeType could not be started");
  if (FT_New_Memory_Face(library.handle, reinterpret_cast<const FT_Byte*>(font_bytes.data()), static_cast<FT_Long>(font_bytes.size()), 0,
                         &library.face) != 0)
    return fail(ErrorCode::InvalidArgument, "this is no font file that can be read");
  const FT_Face face = library.face;
  if (!FT_IS_SCALABLE(face)) return fail(ErrorCode::Unsupported, "the font has pictures of its glyphs, no outlines");
  Line line;
  line.units_per_em = face->units_per_EM;
  Sink sink{line.path};
  FT_Outline_Funcs functions{};
  functions.move_to = move_to, functions.line_to = line_to, functions.conic_to = conic_to, functions.cubic_to = cubic_to;
  FT_UInt before = 0;
  for (const char32_t c : decoded(text)) {
    const FT_UInt glyph = FT_Get_Char_Index(face, c);
    if (glyph == 0) line.missing.push_back(c);
    if (FT_Load_Glyph(face, glyph, FT_LOAD_NO_SCALE) != 0) continue;
    FT_Vector kerning{};
    if (before && glyph && FT_Get_Kerning(face, before, glyph, FT_KERNING_UNSCALED, &kerning) == 0) sink.x += static_cast<double>(kerning.x);
    if (glyph != 0 && face->glyph->format == FT_GLYPH_FORMAT_OUTLINE) {
      FT_Outline_Decompose(&face->glyph->outline, &functions, &sink);
      sink.close();
    }
    sink.x += static_cast<double>(face->glyph->advance.x);
    before = glyph;
  }
  line.width = sink.x;
  return line;
}

}  // namespace trimloop::font
