// Real files: nothing crashes, every face the directory means is there, few fail, every body keeps its promises.

#include "tests/support/corpus.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <set>

#include "tests/io/iges/imported.h"

using namespace trimloop;
using namespace trimloop::test;

namespace {

// A second reader on purpose, from the cards up and as plain as can be: only what is needed to count faces.
class PlainFile {
 public:
  struct Entry {
    int type = 0, form = 0;
    std::vector<std::string> fields;  // [0] is the type
  };

  explicit PlainFile(const std::string& bytes) {
    std::vector<std::string> directory;
    std::map<int, std::string> parameters;
    for (std::string& line : lines(bytes)) {
      line.resize(80, ' ');
      if (line[72] == 'D') directory.push_back(line);
      if (line[72] == 'P') parameters[number(line.substr(73))] = line.substr(0, 64);
    }
    for (std::size_t i = 0; i + 1 < directory.size(); i += 2) {
      Entry e;
      e.type = number(directory[i].substr(0, 8));
      e.form = number(directory[i + 1].substr(32, 8));
      const int first = number(directory[i].substr(8, 8)), count = number(directory[i + 1].substr(24, 8));
      std::string text;
      for (int k = first; k < first + count; ++k) text += parameters[k];
      e.fields = split(text);
      entries[static_cast<int>(i) + 1] = e;
    }
  }

  static int number(const std::string& text) {
    const std::size_t at = text.find_first_not_of(" +");
    int value = 0;
    if (at != std::string::npos) std::from_chars(text.data() + at, text.data() + text.size(), value);
    return value;
  }
  static int pointer(const Entry& e, std::size_t k) { return k < e.fields.size() ? number(e.fields[k]) : 0; }

  std::map<int, Entry> entries;

 private:
  static std::vector<std::string> lines(const std::string& bytes) {
    std::vector<std::string> out(1);
    const bool has_ends = bytes.find_first_of("\r\n") != std::string::npos;
    for (const char c : bytes) {
      if (c == '\r' || c == '\n' || (!has_ends && out.back().size() == 80)) out.emplace_back();
      if (c != '\r' && c != '\n') out.back() += c;
    }
    return out;
  }
  static std::vector<std::string> split(const std::string& text) {
    std::vector<std::string> out(1);
    for (std::size_t i = 0; i < text.size() && text[i] != ';'; ++i) {
      if (text[i] == ',') {
        out.emplace_back();
      } else if (text[i] == 'H' && !out.back().empty() && number(out.back()) > 0) {
        i += static_cast<std::size_t>(number(out.back()));  // a string: its bytes are no syntax
      } else {
        out.back() += text[i];
      }
    }
    return out;
  }
};

// Each 144, 143, 510, bounded plane that is no hole and surface that nothing uses; once for each placement.
class FaceCount {
 public:
  explicit FaceCount(const PlainFile& file) : file_(file) {
    for (const auto& [de, e] : file.entries) {
      const auto at = [&e = e](std::size_t k) { return PlainFile::pointer(e, k); };
      if (e.type == 144 || e.type == 510) used_.insert(at(1));
      if (e.type == 143 || e.type == 142) used_.insert(at(2));
      if (e.type == 141) used_.insert(at(3));
      if (e.type == 140) used_.insert(at(5));
      if (e.type == 402 && e.form == 9)
        for (int k = 0; k < at(2); ++k) used_.insert(at(4 + static_cast<std::size_t>(k)));
      if (e.type == 186) {
        list(de, e, 1, 1, 1);
        list(de, e, 4, 2, at(3));
      }
      if (e.type == 514) list(de, e, 2, 2, at(1));
      if (e.type == 308) list(de, e, 4, 1, at(3));
      if (e.type == 408) members_[de] = {at(1)};
    }
    for (const auto& [owner, parts] : members_)
      if (file.entries.at(owner).type != 408) inside_.insert(parts.begin(), parts.end());
  }

  std::size_t total() const {
    std::size_t sum = 0;
    for (const auto& [de, e] : file_.entries)
      if (!inside_.count(de) && e.type != 308) sum += below(de, 0);
    return sum;
  }

 private:
  void list(int owner, const PlainFile::Entry& e, std::size_t first, std::size_t step, int count) {
    for (int k = 0; k < count; ++k) members_[owner].push_back(PlainFile::pointer(e, first + step * static_cast<std::size_t>(k)));
  }
  std::size_t below(int de, int depth) const {
    const auto found = file_.entries.find(de);
    if (found == file_.entries.end() || depth > 20) return 0;
    const PlainFile::Entry& e = found->second;
    if (const auto parts = members_.find(de); parts != members_.end()) {
      std::size_t sum = 0;
      for (const int part : parts->second) sum += below(part, depth + 1);
      return sum;
    }
    if (e.type == 144 || e.type == 143 || e.type == 510) return 1;
    if (used_.count(de)) return 0;
    if (e.type == 108) return e.form == 1;
    const std::set<int> surfaces{114, 118, 120, 122, 128, 140, 190, 192, 194, 196, 198};
    return surfaces.count(e.type);
  }

  const PlainFile& file_;
  std::set<int> used_, inside_;
  std::map<int, std::vector<int>> members_;
};

// Some entity of types 150 to 168 in the directory.
bool has_csg(const std::string& bytes) {
  const PlainFile file(bytes);
  return std::any_of(file.entries.begin(), file.entries.end(),
                     [](const auto& e) { return e.second.type >= 150 && e.second.type <= 168; });
}

}  // namespace

BOOST_AUTO_TEST_SUITE(corpus)

BOOST_AUTO_TEST_CASE(every_face_of_every_real_file_is_there_and_few_fail) {
  std::size_t faces = 0, failed = 0;
  for (const auto& path : corpus_files("iges")) {
    const std::string bytes = read_file(path);
    const std::size_t wanted = FaceCount(PlainFile(bytes)).total();
    Report report;
    const auto file = iges::File::parse(bytes, {}, report);
    const Model model = io::iges_import::import(file, {}, {}, report);
    const auto n = count(model);
    BOOST_REQUIRE(n);
    // What the faces of a CSG solid are is not in its record; there are some.
    if (has_csg(bytes))
      BOOST_TEST(n->faces > wanted, path.filename() << " has solids without faces");
    else
      BOOST_TEST(n->faces == wanted, path.filename() << ": " << n->faces << " faces, the directory means " << wanted);
    faces += n->faces;
    failed += n->faces_failed;
    for (const Part& part : model.parts) {
      for (const Body& body : part.bodies) {
        // Healing leaves gaps of up to a millionth of a loop to the vertices, which say so.
        Box box;
        for (const Vertex& v : body.vertices) box.add(v.point);
        const double tolerance = std::max({10 * model.resolution_mm, 1e-5, 1e-6 * box.diagonal()});
        for (const std::string& broken : broken_promises(body, tolerance))
          BOOST_TEST(false, path.filename() << ": " << broken);
        for (const Face& f : body.faces) {
          BOOST_TEST(!f.source.empty());
          BOOST_TEST((f.status == FaceStatus::Ok || !f.reason.empty()));
        }
      }
    }
  }
  BOOST_TEST_MESSAGE(faces << " faces, " << failed << " failed");
  BOOST_TEST(failed * 100 <= faces);
}

BOOST_AUTO_TEST_SUITE_END()
