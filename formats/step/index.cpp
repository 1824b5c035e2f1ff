// One pass over the bytes: sections, and for each instance its name, place and keyword. Nothing is decoded.
// ISO 10303-21:2016 clause 5.3 and table 3:
//   file := "ISO-10303-21;" header [anchor] [reference] { data } "END-ISO-10303-21;" { signature }
//   data := "DATA" [ parameters ] ";" { "#" digits "=" value ";" } "ENDSEC;"

#include <fmt/format.h>

#include <cstring>
#include <limits>

#include "base/bytes.h"
#include "formats/step/header.h"
#include "formats/step/rules.h"
#include "formats/step/scan.h"

namespace trimloop::step {
namespace {

using Kind = StatementEnd::Kind;

bool is_upper_word(char c) { return (c >= 'A' && c <= 'Z') || is_digit(c) || c == '_'; }

std::string upper(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return out;
}

}  // namespace

class Indexer {
 public:
  Indexer(File& file, const Limits& limits, Report& report)
      : file_(file), limits_(limits), report_(report), bytes_(file.bytes_) {}

  void run() {
    slots_.assign(1024, 0);
    file_.keywords_.push_back({});  // 0: what is beyond the number of keywords that an index entry can name
    if (!begin()) return;
    bool at_end = false;
    while (!at_end && at_ < bytes_.size()) {
      skip();
      if (at_ >= bytes_.size()) break;
      at_end = statement();
    }
    if (!at_end) {
      close_section(bytes_.size());
      if (!report_.has_fatal()) add(rules::end_missing, bytes_.size(), "END-ISO-10303-21 is missing");
    }
    after_end();
    check_header();
    file_.build_lookup(report_);
  }

 private:
  Diagnostic& add(const Rule& rule, std::size_t offset, std::string text, std::size_t length = 1) {
    Diagnostic& d = report_.add(rule, std::move(text));
    d.location.offset = std::min(offset, bytes_.size());
    d.location.length = length;
    return d;
  }

  void skip() {
    bool open = false;
    const std::size_t from = at_;
    at_ = skip_blanks(bytes_, at_, &open);
    if (open) add(rules::comment_open, from, "a comment does not end");
  }

  std::string_view word_at(std::size_t at) const {
    std::size_t end = at;
    while (end < bytes_.size() && is_word(bytes_[end])) ++end;
    return bytes_.substr(at, end - at);
  }

  bool begin() {
    if (bytes_.substr(0, 3) == "\xEF\xBB\xBF") {
      at_ = 3;
      add(rules::encoding, 0, "the file begins with a byte-order mark");
    }
    const auto first = bytes_.substr(0, 2);
    if (first == "\xFF\xFE" || first == "\xFE\xFF") {
      add(rules::encoding, 0, "the file is UTF-16");
      add(rules::not_part21, 0, "the file is UTF-16; Part 21 is written in single bytes");
      return false;
    }
    skip();
    const std::string word = upper(word_at(at_).substr(0, 20));
    if (word == "ISO-10303-21") {
      at_ += word.size();
      end_statement("ISO-10303-21");
      return true;
    }
    const bool frame = word == "HEADER" || word == "DATA" || bytes_.find("HEADER;", at_) < at_ + 4096;
    if (!frame || bytes_.find("DATA", at_) == std::string_view::npos) {
      add(rules::not_part21, at_, "the file does not begin with ISO-10303-21");
      return false;
    }
    report_.add(rules::not_part21, Severity::Error, "ISO-10303-21 is missing at the beginning; the rest is read").location.offset = at_;
    if (word != "HEADER" && word != "DATA") at_ = bytes_.find("HEADER;", at_);
    return true;
  }

  // The ';' after a keyword that stands alone.
  void end_statement(std::string_view word) {
    skip();
    if (at_ < bytes_.size() && bytes_[at_] == ';') ++at_;
    else add(rules::terminator, at_, fmt::format("a semicolon is missing after {}", word));
  }

  void close_section(std::size_t end) {
    if (!open_) return;
    Section& s = file_.sections_.back();
    s.length = end - s.offset;
    s.end_instance = file_.instances_.size();
    open_ = false;
  }

  void open_section(Section::Kind kind, std::size_t offset) {
    if (open_) {
      add(rules::section_order, offset, "ENDSEC is missing before this section");
      close_section(offset);
    }
    if (!file_.sections_.empty() && kind < file_.sections_.back().kind)
      add(rules::section_order, offset, "this section comes after one that it should come before");
    Section s;
    s.kind = kind;
    s.offset = offset;
    s.first_instance = s.end_instance = file_.instances_.size();
    file_.sections_.push_back(std::move(s));
    open_ = true;
  }

  // One statement of whatever section; true at END-ISO-10303-21.
  bool statement() {
    const char c = bytes_[at_];
    if (c == '#') {
      if (open_ && file_.sections_.back().kind == Section::Kind::Reference) return edition3(), false;
      if (!open_ || file_.sections_.back().kind != Section::Kind::Data) open_section(Section::Kind::Data, at_);
      return instance(), false;
    }
    if (c == ';') {
      report_.add(rules::terminator, Severity::Warning, "a semicolon too many").location.offset = at_;
      ++at_;
      return false;
    }
    if (c == '<' && open_ && file_.sections_.back().kind <= Section::Kind::Reference) return edition3(), false;
    const std::size_t begin = at_;
    const std::string_view raw = word_at(at_);
    const std::string word = upper(raw.substr(0, 40));
    if (word == "END-ISO-10303-21") {
      if (open_) add(rules::section_order, at_, "ENDSEC is missing before the end");
      close_section(at_);
      at_ += raw.size();
      end_statement(word);
      return true;
    }
    if (word == "ENDSEC") {
      at_ += raw.size();
      end_statement(word);
      if (!open_) add(rules::section_order, begin, "ENDSEC without a section");
      close_section(at_);
      return false;
    }
    if (word == "ENDSCOPE" && !scopes_.empty()) return end_scope(), false;
    if (word == "HEADER" || word == "DATA" || word == "ANCHOR" || word == "REFERENCE" || word == "SIGNATURE") {
      const std::size_t next = skip_blanks(bytes_, at_ + raw.size());
      const char after = next < bytes_.size() ? bytes_[next] : ';';
      if (after == ';' || (after == '(' && word == "DATA")) {
        open_section(word == "HEADER"      ? Section::Kind::Header
                     : word == "DATA"      ? Section::Kind::Data
                     : word == "ANCHOR"    ? Section::Kind::Anchor
                     : word == "REFERENCE" ? Section::Kind::Reference
                                           : Section::Kind::Signature,
                     begin);
        at_ = next;
        if (after == '(') data_parameters();
        end_statement(word);
        if (word == "SIGNATURE") signature();
        return false;
      }
    }
    const StatementEnd end = find_statement_end(bytes_, at_);
    if (open_ && file_.sections_.back().kind == Section::Kind::Header && !raw.empty()) {
      header_.push_back({begin, end.at - begin});
    } else {
      add(rules::section_order, begin, fmt::format("this belongs to no section: {}", printable(bytes_.substr(begin, end.at - begin), 60)));
    }
    finish(end, begin);
    return false;
  }

  // Goes behind the end of a statement and says what was wrong with it.
  void finish(const StatementEnd& end, std::size_t begin) {
    switch (end.kind) {
      case Kind::Semicolon: break;
      case Kind::NextInstance: add(rules::terminator, end.at, "the semicolon before this instance is missing"); break;
      case Kind::OpenString: add(rules::string_open, end.at, "a string does not end; the next instance is taken to begin behind it"); break;
      case Kind::OpenComment: add(rules::comment_open, end.at, "a comment does not end"); break;
      case Kind::EndOfFile:
        if (end.at < bytes_.size()) {
          Diagnostic& d = report_.add(rules::string_open, file_.instances_.empty() ? Severity::Fatal : Severity::Error,
                                      "a string does not end before the file does");
          d.location.offset = end.at;
        } else {
          add(rules::terminator, begin, "the last statement does not end");
        }
        break;
    }
    at_ = std::max(end.resume, begin + 1);
  }

  void instance() {
    const std::size_t begin = at_++;
    std::uint64_t id = 0;
    const std::size_t first = at_;
    bool over = false;
    for (; at_ < bytes_.size() && is_digit(bytes_[at_]); ++at_) {
      over = over || id > (std::numeric_limits<std::uint64_t>::max() - 9) / 10;
      id = id * 10 + static_cast<std::uint64_t>(bytes_[at_] - '0');
    }
    const bool has_digits = at_ > first;
    if (at_ < bytes_.size() && bytes_[at_] != '=') skip();
    if (!has_digits || at_ >= bytes_.size() || bytes_[at_] != '=') {
      add(rules::instance_malformed, begin, fmt::format("this is no instance: {}", printable(bytes_.substr(begin, 30), 40)));
      return finish(find_statement_end(bytes_, at_), begin);
    }
    ++at_;
    if (at_ < bytes_.size() && (is_blank(bytes_[at_]) || bytes_[at_] == '/')) skip();
    if (over) id = 0;  // from here on 0 stands for "no name": its value is passed over
    if (id == 0) add(rules::instance_zero, begin, over ? "the name of an instance is over 64 bits" : "an instance is named #0");
    if (bytes_.substr(at_, 6) == "&SCOPE") {  // edition 1: the instances inside come first, then the value
      scopes_.push_back(id);
      at_ += 6;
      return;
    }
    record(id, begin);
  }

  // ENDSCOPE [ "/" names "/" ] value ";"
  void end_scope() {
    const std::size_t begin = at_;
    const std::uint64_t id = scopes_.back();
    scopes_.pop_back();
    at_ += 8;
    skip();
    if (at_ < bytes_.size() && bytes_[at_] == '/') {
      const std::size_t end = bytes_.find('/', at_ + 1);
      at_ = end == std::string_view::npos ? bytes_.size() : end + 1;
      skip();
    }
    record(id, begin);
  }

  // The value of an instance, from its keyword to the ';'.
  void record(std::uint64_t id, std::size_t begin) {
    if (id == 0) return finish(find_statement_end(bytes_, at_), begin);
    const std::size_t value = at_;
    while (at_ < bytes_.size() && is_upper_word(bytes_[at_])) ++at_;
    std::string_view word = bytes_.substr(value, at_ - value);
    std::string turned;
    const bool is_complex = word.empty() && at_ < bytes_.size() && bytes_[at_] == '(';
    if (!is_complex && at_ < bytes_.size() && bytes_[at_] != '(' && !is_blank(bytes_[at_])) {
      turned = upper(bytes_[at_] == '!' && word.empty() ? bytes_.substr(at_, 1 + word_at(at_ + 1).size()) : word_at(value));
      at_ = value + turned.size();
      word = turned;
      if (!turned.empty() && turned[0] == '!') {
        if (!told_user_defined_) add(rules::user_defined, value, fmt::format("a user-defined entity: {}", printable(turned, 60)));
        told_user_defined_ = true;
      } else if (!turned.empty()) {
        if (!told_case_) add(rules::keyword_case, value, "a keyword is not in capitals");
        told_case_ = true;
      }
    }
    const StatementEnd end = find_statement_end(bytes_, at_);
    if (end.kind == Kind::Semicolon) {
      at_ = end.resume;
    } else {
      finish(end, begin);
      if (report_.has_fatal()) return;  // a file of one string without an end has no instances
    }
    if (word.empty() && !is_complex) {
      add(rules::instance_malformed, value, "no keyword follows the name of the instance");
      return;
    }
    const std::size_t length = end.at + (end.kind == Kind::Semicolon) - begin;
    if (length > std::numeric_limits<std::uint32_t>::max() || value - begin > std::numeric_limits<std::uint16_t>::max() ||
        file_.instances_.size() >= std::numeric_limits<std::uint32_t>::max() - 1) {
      add(rules::instance_malformed, begin, "the instance is too long to be read");
      return;
    }
    Instance i;
    i.id = id;
    i.offset = begin;
    i.length = static_cast<std::uint32_t>(length);
    i.value = static_cast<std::uint16_t>(value - begin);
    i.keyword = is_complex ? complex_keyword(bytes_.substr(value, end.at - value)) : keyword(word, false);
    ++file_.keywords_[i.keyword].count;
    file_.instances_.push_back(i);
  }

  // "A+B+C" of (A(...)B(...)C(...)).
  std::uint16_t complex_keyword(std::string_view text) {
    joined_.clear();
    std::string_view before;
    int depth = 0;
    bool ordered = true;
    for (std::size_t i = 0; i < text.size();) {
      const char c = text[i];
      if (c == '\'') {
        const std::size_t end = end_of_string(text, i);
        i = end == std::string_view::npos ? text.size() : end + 1;
      } else if (c == '/' || is_blank(c)) {
        const std::size_t next = skip_blanks(text, i);
        i = next == i ? i + 1 : next;
      } else if (depth == 1 && (is_word(c) || c == '!')) {
        std::size_t end = i + 1;
        while (end < text.size() && is_word(text[end])) ++end;
        const std::string_view part = text.substr(i, end - i);
        ordered = ordered && before < part;
        before = part;
        if (!joined_.empty()) joined_ += '+';
        joined_ += part;
        i = end;
      } else {
        depth += (c == '(') - (c == ')');
        ++i;
      }
    }
    const std::uint16_t k = keyword(joined_, true);
    if (!ordered && file_.keywords_[k].count == 0) {
      Diagnostic& d = add(rules::complex_order, static_cast<std::size_t>(text.data() - bytes_.data()),
                          "the parts of a complex instance are not in alphabetical order, or one comes twice");
      d.type = joined_.substr(0, 100);
    }
    return k;
  }

  static std::uint64_t hash(std::string_view word) {
    std::uint64_t h = word.size() * 0x9E3779B97F4A7C15u;
    std::uint64_t head = 0, tail = 0;
    const std::size_t n = std::min<std::size_t>(word.size(), 8);
    std::memcpy(&head, word.data(), n);
    std::memcpy(&tail, word.data() + word.size() - n, n);
    h = (h ^ head) * 0xFF51AFD7ED558CCDu;
    h = (h ^ (h >> 32) ^ tail) * 0xC4CEB9FE1A85EC53u;
    if (word.size() > 16) {
      std::uint64_t middle = 0;
      std::memcpy(&middle, word.data() + word.size() / 2 - 4, 8);
      h = (h ^ (h >> 29) ^ middle) * 0x9E3779B97F4A7C15u;
    }
    return h ^ (h >> 31);
  }

  std::uint16_t keyword(std::string_view word, bool is_complex) {
    std::size_t slot = hash(word) & (slots_.size() - 1);
    for (; slots_[slot] != 0; slot = (slot + 1) & (slots_.size() - 1)) {
      const Keyword& known = file_.keywords_[slots_[slot]];
      if (known.name == word && known.is_complex == is_complex) return slots_[slot];
    }
    if (file_.keywords_.size() > 30000) return 0;
    Keyword k;
    k.name = word;
    k.is_complex = is_complex;
    if (!is_complex) {
      k.entity = entity_of(word);
      k.is = with_supertypes(k.entity);
    } else {
      for (std::size_t from = 0; from < word.size();) {
        const std::size_t end = std::min(word.find('+', from), word.size());
        k.is |= with_supertypes(entity_of(upper(word.substr(from, end - from))));
        from = end + 1;
      }
    }
    file_.keywords_.push_back(std::move(k));
    const auto made = static_cast<std::uint16_t>(file_.keywords_.size() - 1);
    slots_[slot] = made;
    if (file_.keywords_.size() * 2 > slots_.size()) grow();
    return made;
  }

  void grow() {
    slots_.assign(slots_.size() * 2, 0);
    for (std::size_t k = 1; k < file_.keywords_.size(); ++k) {
      std::size_t slot = hash(file_.keywords_[k].name) & (slots_.size() - 1);
      while (slots_[slot] != 0) slot = (slot + 1) & (slots_.size() - 1);
      slots_[slot] = static_cast<std::uint16_t>(k);
    }
  }

  // DATA('name',('SCHEMA'))
  void data_parameters() {
    const StatementEnd end = find_statement_end(bytes_, at_);
    read_data_parameters(bytes_.substr(at_, end.at - at_), limits_, file_.sections_.back().name, file_.sections_.back().schemas);
    at_ = end.at;
  }

  // <name>=item{tags};   #id=<uri>;
  void edition3() {
    const std::size_t begin = at_;
    const bool anchor = file_.sections_.back().kind == Section::Kind::Anchor;
    std::size_t end = bytes_.find(';', at_);
    if (end == std::string_view::npos) end = bytes_.size();
    const std::string_view text = bytes_.substr(begin, end - begin);
    const std::size_t equals = text.find('=');
    std::string left(text.substr(0, equals));
    while (!left.empty() && is_blank(left.back())) left.pop_back();
    std::string right(equals == std::string_view::npos ? std::string_view{} : text.substr(skip_blanks(text, equals + 1)));
    if (equals == std::string_view::npos) {
      add(rules::edition3, begin, fmt::format("this is neither an anchor nor a reference: {}", printable(text, 60)));
    } else if (anchor) {
      for (const Anchor& known : file_.anchors_)
        if (file_.anchors_.size() < 1000 && known.name == left)
          report_.add(rules::edition3, Severity::Error, fmt::format("the anchor {} is defined twice", printable(left, 60))).location.offset = begin;
      file_.anchors_.push_back({std::move(left), std::move(right), begin});
    } else {
      add(rules::edition3, begin, fmt::format("{} stands for {}, outside this file; it is not fetched", printable(left, 40), printable(right, 100)));
      file_.references_.push_back({std::move(left), std::move(right), begin});
    }
    at_ = std::min(end + 1, bytes_.size());
  }

  // Base64 up to its ENDSEC; the signed bytes stay as they are.
  void signature() {
    add(rules::signature, file_.sections_.back().offset, "a signature section is there; it is not verified");
    const std::size_t end = bytes_.find("ENDSEC", at_);
    at_ = end == std::string_view::npos ? bytes_.size() : end;
  }

  void after_end() {
    while (at_ < bytes_.size()) {
      skip();
      if (at_ >= bytes_.size()) return;
      const std::string_view word = word_at(at_);
      if (word == "SIGNATURE" || (word == "ENDSEC" && open_)) {
        statement();
      } else {
        add(rules::after_end, at_, fmt::format("{} bytes follow the end of the file", bytes_.size() - at_), bytes_.size() - at_);
        break;
      }
    }
    close_section(bytes_.size());
  }

  void check_header() {
    if (report_.has_fatal()) return;
    file_.header_ = read_header(bytes_, header_, limits_, report_);
    std::size_t data = 0;
    bool unnamed = false, has_header = false;
    for (const Section& s : file_.sections_) {
      has_header = has_header || s.kind == Section::Kind::Header;
      if (s.kind != Section::Kind::Data) continue;
      ++data;
      unnamed = unnamed || s.schemas.empty();
    }
    if (!has_header) add(rules::header_missing, 0, "there is no HEADER section");
    if (data > 1 && unnamed) add(rules::multi_data, 0, fmt::format("{} DATA sections, not all with a name and a schema", data));
  }

  File& file_;
  const Limits& limits_;
  Report& report_;
  std::string_view bytes_;
  std::size_t at_ = 0;
  bool open_ = false, told_case_ = false, told_user_defined_ = false;
  std::vector<std::uint16_t> slots_;
  std::vector<std::uint64_t> scopes_;
  std::vector<HeaderEntity> header_;
  std::string joined_;
};

File File::parse(std::string bytes, const Limits& limits, Report& report) {
  File file;
  file.bytes_ = std::move(bytes);
  file.instances_.reserve(file.bytes_.size() / 80);
  Indexer(file, limits, report).run();
  return file;
}

void File::build_lookup(Report& report) {
  std::uint64_t largest = 0;
  for (const Instance& i : instances_) largest = std::max(largest, i.id);
  const bool is_dense = largest < 4 * static_cast<std::uint64_t>(instances_.size()) + 4096;
  if (is_dense) dense_.assign(static_cast<std::size_t>(largest) + 1, 0);
  else sparse_.reserve(instances_.size());
  for (std::uint32_t k = 0; k < instances_.size(); ++k) {
    const Instance& i = instances_[k];
    std::uint32_t* place = is_dense ? &dense_[static_cast<std::size_t>(i.id)] : &sparse_[i.id];
    if (*place == 0) {
      *place = k + 1;
      continue;
    }
    const Instance& before = instances_[*place - 1];
    for (const Instance* twice : {&before, &i}) {
      Diagnostic& d = report.add(rules::instance_duplicate, fmt::format("#{} is defined twice; the first one counts", i.id));
      d.location.offset = twice->offset;
      d.entity = fmt::format("#{}", i.id);
      d.type = keywords_[twice->keyword].name;
    }
  }
}

const Instance* File::find(Ref ref) const {
  std::uint32_t place = 0;
  if (!dense_.empty()) {
    place = ref.id < dense_.size() ? dense_[static_cast<std::size_t>(ref.id)] : 0;
  } else if (const auto at = sparse_.find(ref.id); at != sparse_.end()) {
    place = at->second;
  }
  return place ? &instances_[place - 1] : nullptr;
}

std::string_view File::value(const Instance& i) const {
  std::string_view all = text(i).substr(i.value);
  if (!all.empty() && all.back() == ';') all.remove_suffix(1);
  return all;
}

void File::locate(Report& report) const {
  const LineIndex lines(bytes_);
  report.locate([&](Location& l) {
    if (l.offset == Location::nowhere) return;
    const LineColumn at = lines.locate(l.offset);
    l.line = at.line;
    l.column = at.column;
  });
}

Location File::locate(std::size_t offset) const {
  Location l;
  l.offset = offset;
  const LineColumn at = LineIndex(bytes_).locate(offset);
  l.line = at.line;
  l.column = at.column;
  return l;
}

bool sniff(std::string_view first) {
  if (first.substr(0, 3) == "\xEF\xBB\xBF") first.remove_prefix(3);
  const std::string_view rest = first.substr(skip_blanks(first, 0));
  return rest.substr(0, 12) == "ISO-10303-21" || rest.substr(0, 7) == "HEADER;" ||
         (rest.find("HEADER;") != std::string_view::npos && rest.find("FILE_SCHEMA") != std::string_view::npos);
}

}  // namespace trimloop::step
