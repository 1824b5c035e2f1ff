#include "io/names.h"

#include <algorithm>
#include <unordered_set>

namespace trimloop::io {

namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_slash(char c) { return c == '/' || c == '\\'; }

bool has_control(std::string_view s) {
  return std::any_of(s.begin(), s.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == '\x7f'; });
}

// "<a ...>", "</a>", "<!...>".
bool has_markup(std::string_view s) {
  for (std::size_t at = s.find('<'); at != std::string_view::npos && at + 1 < s.size(); at = s.find('<', at + 1)) {
    const char next = s[at + 1];
    if ((is_letter(next) || next == '/' || next == '!') && s.find('>', at) != std::string_view::npos) return true;
  }
  return false;
}

// One component of the path is "..".
bool climbs(std::string_view s) {
  for (std::size_t at = s.find(".."); at != std::string_view::npos; at = s.find("..", at + 1)) {
    const bool begins = at == 0 || is_slash(s[at - 1]), ends = at + 2 < s.size() && is_slash(s[at + 2]);
    if (begins && ends) return true;
  }
  return false;
}

class Collector {
 public:
  explicit Collector(const Model& model) : model_(model) {}

  void add(const std::string& text, const SourceRefs& source) {
    const std::string_view part = hostile_part(text);
    if (!part.empty() && seen_.insert(text).second) out.push_back({text, part, source});
  }
  void add(AttributesId attributes, const SourceRefs& source) {
    if (attributes) add(model_[attributes].name, source);
  }
  void add(const std::vector<Annotation>& of) {
    for (const Annotation& a : of) {
      add(a.attributes, a.source);
      for (const TextRun& t : a.texts) add(t.text, a.source);
    }
  }

  std::vector<HostileName> out;

 private:
  const Model& model_;
  std::unordered_set<std::string> seen_;
};

}  // namespace

std::string_view hostile_part(std::string_view text) {
  if (has_control(text)) return "control characters";
  if (has_markup(text)) return "markup";
  const bool formula = text.size() > 1 && (text[0] == '=' || text[0] == '@') && is_letter(text[1]);
  if (formula && text.find_first_of("(|!") != std::string_view::npos) return "a formula";
  if (climbs(text)) return "a path";
  return {};
}

bool escapes_folder(std::string_view s) {
  if (s.empty()) return false;
  const bool drive = s.size() > 1 && is_letter(s[0]) && s[1] == ':';
  return is_slash(s[0]) || drive || climbs(s) || s == ".." || s.find("://") != std::string_view::npos ||
         (s.size() > 2 && s.substr(s.size() - 2) == ".." && is_slash(s[s.size() - 3]));
}

std::vector<HostileName> hostile_names(const Model& model) {
  Collector c(model);
  for (const Part& part : model.parts) {
    c.add(part.name, part.source);
    for (const Body& body : part.bodies) {
      c.add(body.attributes, body.source);
      for (const Face& face : body.faces) c.add(face.attributes, face.source);
    }
    for (const FreeCurve& curve : part.curves) c.add(curve.attributes, curve.source);
    for (const FreePoint& point : part.points) c.add(point.attributes, point.source);
    c.add(part.annotation);
    for (const Instance& instance : part.instances) c.add(instance.attributes, instance.source);
  }
  for (const std::string& layer : model.layer_names) c.add(layer, {});
  for (const View& view : model.views) c.add(view.name, view.source);
  for (const Drawing& drawing : model.drawings) {
    c.add(drawing.name, drawing.source);
    c.add(drawing.annotation);
  }
  return std::move(c.out);
}

}  // namespace trimloop::io
