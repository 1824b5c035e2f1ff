#include "formats/iges/global.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "base/bytes.h"
#include "base/number.h"
#include "formats/iges/rules.h"
#include "formats/iges/tokens.h"

namespace trimloop::iges {

void join_columns(const Cards& cards, const Card* first, std::size_t count, std::size_t width, std::string& out) {
  out.clear();
  out.reserve(count * width);
  for (std::size_t i = 0; i < count; ++i) {
    const std::string_view data = cards.columns(first[i], 0, width);
    out += data;
    out.append(width - data.size(), ' ');
  }
}

namespace {

constexpr std::size_t global_columns = 72;
constexpr std::size_t most_cards = 10'000;       // real ones have four; more are not read
constexpr std::size_t least_usable_fields = 15;  // units and scale are among them

struct UnitName {
  std::string_view name;
  int flag;
};
constexpr UnitName unit_names[] = {
    {"IN", 1},         {"INCH", 1},   {"INCHES", 1}, {"MM", 2},          {"MILLIMETER", 2},  {"MILLIMETERS", 2},
    {"MILLIMETRE", 2}, {"FT", 4},     {"FEET", 4},   {"FOOT", 4},        {"MI", 5},          {"MILE", 5},
    {"M", 6},          {"METER", 6},  {"METERS", 6}, {"METRE", 6},       {"KM", 7},          {"MIL", 8},
    {"UM", 9},         {"MICRON", 9}, {"CM", 10},    {"CENTIMETER", 10}, {"CENTIMETRE", 10}, {"UIN", 11}};

// Unit flag of a name, 0 when it is none that we know.
int flag_of_name(std::string_view name) {
  std::string upper;
  for (char c : name)
    if (c != ' ') upper += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  for (const UnitName& unit : unit_names)
    if (unit.name == upper) return unit.flag;
  return 0;
}

double mm_of_flag(int flag) {
  switch (flag) {
    case 1:
      return 25.4;
    case 4:
      return 304.8;
    case 5:
      return 1609344.0;
    case 6:
      return 1000.0;
    case 7:
      return 1e6;
    case 8:
      return 0.0254;
    case 9:
      return 0.001;
    case 10:
      return 10.0;
    case 11:
      return 2.54e-5;
    default:
      return 1.0;  // 2, and what is not known
  }
}

// 2.2.4.3.1: what could be part of a value cannot delimit it.
bool may_delimit(char c) {
  return c > ' ' && c < '\x7f' && std::string_view("0123456789+-.DEH").find(c) == std::string_view::npos;
}

// "YYYYMMDD.HHNNSS" or "YYMMDD.HHNNSS".
bool is_date(std::string_view text) {
  if (text.size() == 13)
    text.remove_prefix(2);
  else if (text.size() == 15)
    text.remove_prefix(4);
  else
    return false;
  if (text[4] != '.') return false;
  const auto pair = [text](std::size_t at) {
    const char a = text[at], b = text[at + 1];
    return a < '0' || a > '9' || b < '0' || b > '9' ? 100 : (a - '0') * 10 + (b - '0');
  };
  return pair(0) >= 1 && pair(0) <= 12 && pair(2) >= 1 && pair(2) <= 31 && pair(5) < 24 && pair(7) < 60 && pair(9) < 60;
}

// With the century, so that dates compare as text.
std::string full_date(const std::string& text) {
  if (text.size() == 15) return text;
  std::string full = text[0] >= '7' ? "19" : "20";
  full += text;
  return full;
}

class GlobalReader {
 public:
  GlobalReader(const Cards& cards, Report& report) : cards_(cards), report_(report) {}

  Global read() {
    const auto& section = cards_.global.cards;
    join_columns(cards_, section.data(), std::min(section.size(), most_cards), global_columns, text_);
    if (read_structure()) {
      read_fields();
      judge_numbers();
      judge_units();
      judge_rest();
    }
    return std::move(g_);
  }

 private:
  // -- delimiters and fields

  bool read_structure() {
    if (text_.find_first_not_of(' ') == std::string::npos) {
      say(rules::global_missing, 0,
          cards_.global.empty() ? "there is no Global section" : "the Global section is blank");
      return false;
    }
    const auto opening = read_delimiters(text_);
    if (!opening) {
      say(rules::global_missing, 0,
          fmt::format("the Global section starts with '{}', not with its delimiters", printable(text_, 12)));
      return false;
    }
    if (!check_delimiters(*opening)) return false;
    std::vector<LexFault> faults;
    Lexed lexed{opening->end, true};
    tokens_.resize(3);  // so that parameter n is tokens_[n]
    if (!opening->record_ends) {
      const Lexer lexer(opening->parameter, opening->record);
      lexed = lexer.lex(std::string_view(text_).substr(opening->end), tokens_, faults);
      for (std::size_t i = 3; i < tokens_.size(); ++i) tokens_[i].offset += opening->end;
    }
    g_.fields_present = tokens_.size() - 1;
    return check_structure(lexed, faults);
  }

  bool check_delimiters(const Delimiters& d) {
    g_.parameter_delimiter = d.parameter;
    g_.record_delimiter = d.record;
    bool fine = true;
    const auto refuse = [&](const Rule& rule, int parameter, std::string text) {
      say(rule, parameter, std::move(text), Severity::Fatal);
      fine = false;
    };
    if (!may_delimit(d.parameter))
      refuse(rules::param_delimiter, 1, fmt::format("'{}' cannot delimit parameters", printable({&d.parameter, 1})));
    if (!may_delimit(d.record))
      refuse(rules::record_delimiter, 2, fmt::format("'{}' cannot delimit records", printable({&d.record, 1})));
    if (d.parameter == d.record)
      refuse(rules::delimiters_equal, 2,
             fmt::format("'{}' delimits parameters and records", printable({&d.record, 1})));
    return fine;
  }

  // Without its end, or after a string that ran away, the section is believed only if units and scale came before.
  bool check_structure(const Lexed& lexed, const std::vector<LexFault>& faults) {
    bool fine = true;
    for (const LexFault& fault : faults) {
      const int parameter = static_cast<int>(fault.token);
      if (fault.kind == LexFault::Kind::SmallH || fault.kind == LexFault::Kind::TooManyTokens) continue;
      const bool absurd = fault.kind == LexFault::Kind::CountPassesAll;
      const char* what = absurd                                         ? "counts more characters than the section has"
                         : fault.kind == LexFault::Kind::CountPassesEnd ? "counts more characters than it has"
                         : fault.kind == LexFault::Kind::TextBehindString
                             ? "has more characters than it counts"
                             : "has length 0: leave the field empty instead";
      const bool harmless = fault.kind == LexFault::Kind::EmptyString;
      const Severity severity = harmless ? Severity::Warning : absurd ? Severity::Fatal : Severity::Error;
      say(rules::global_hollerith, parameter, fmt::format("the string in field {} {}", parameter, what), severity);
      fine = fine && severity != Severity::Fatal;
    }
    if (!lexed.terminated) {
      const bool usable = g_.fields_present >= least_usable_fields;
      say(rules::global_not_terminated, 0,
          fmt::format("the record delimiter '{}' is missing after {} fields", g_.record_delimiter, g_.fields_present),
          usable ? Severity::Error : Severity::Fatal);
      fine = fine && usable;
    }
    if (g_.fields_present < 24 || g_.fields_present > 26) {
      Diagnostic& d = say(rules::global_field_count, 0,
                          fmt::format("the Global section has {} fields, not 24 to 26", g_.fields_present));
      d.measured = static_cast<double>(g_.fields_present);
      d.limit = g_.fields_present < 24 ? 24 : 26;
    }
    return fine;
  }

  // -- decoding: an absent or bad field keeps its default

  const Token* field(std::size_t n) const {
    return n < tokens_.size() && tokens_[n].kind != Token::Kind::Empty ? &tokens_[n] : nullptr;
  }

  void string(std::size_t n, std::string& out) {
    const Token* token = field(n);
    if (!token || token->text.empty()) return;  // 0H, which says no more than an empty field
    out = token->text;
    if (token->kind == Token::Kind::Text)
      say(rules::global_field_type, static_cast<int>(n),
          fmt::format("field {} is '{}', not a string with its length", n, printable(token->text, 40)));
  }

  void real(std::size_t n, double& out) {
    const Token* token = field(n);
    if (!token) return;
    const auto value = read_real(token->text);
    if (token->kind == Token::Kind::Text && std::isfinite(value.value) &&
        (value || value.fault == NumberFault::Underflow))
      out = value.value;
    else
      say(rules::global_field_type, static_cast<int>(n),
          fmt::format("field {} is '{}', not a real number", n, printable(token->text, 40)));
  }

  // False when something else stands there.
  bool integer(std::size_t n, int& out) {
    const Token* token = field(n);
    if (!token) return true;
    const auto value = read_integer(token->text);
    if (token->kind == Token::Kind::Text && value && value.value >= INT32_MIN && value.value <= INT32_MAX) {
      out = static_cast<int>(value.value);
      return true;
    }
    say(rules::global_field_type, static_cast<int>(n),
        fmt::format("field {} is '{}', not an integer", n, printable(token->text, 40)));
    return false;
  }

  void read_fields() {
    string(3, g_.sender_product);
    string(4, g_.file_name);
    string(5, g_.native_system);
    string(6, g_.preprocessor);
    integer(7, g_.integer_bits);
    integer(8, g_.single_magnitude);
    integer(9, g_.single_significance);
    integer(10, g_.double_magnitude);
    integer(11, g_.double_significance);
    g_.receiver_product = g_.sender_product;
    string(12, g_.receiver_product);
    real(13, g_.model_scale);
    if (!integer(14, g_.unit_flag)) g_.unit_flag = 0;
    string(15, g_.unit_name);
    integer(16, g_.weight_gradations);
    real(17, g_.max_line_width);
    string(18, g_.date);
    real(19, g_.resolution);
    real(20, g_.max_coordinate);
    string(21, g_.author);
    string(22, g_.organization);
    integer(23, g_.version_flag);
    integer(24, g_.drafting_standard);
    string(25, g_.modified);
    string(26, g_.protocol);
  }

  // -- judging

  void judge_numbers() {
    if (g_.integer_bits < 8 || g_.integer_bits > 128)
      say(rules::integer_bits, 7, fmt::format("integers of {} bits", g_.integer_bits));
    positive(rules::single_precision, 8, g_.single_magnitude, 38);
    positive(rules::single_precision, 9, g_.single_significance, 6);
    positive(rules::double_precision, 10, g_.double_magnitude, 308);
    positive(rules::double_precision, 11, g_.double_significance, 15);
    if (!(g_.model_scale >= 1e-300)) {
      say(rules::model_scale, 13, fmt::format("the model scale is {}; 1 is used", g_.model_scale)).measured =
          g_.model_scale;
      g_.model_scale = 1;
    } else if (g_.model_scale != 1) {
      say(rules::model_scale, 13, fmt::format("the model scale is {}; lengths are divided by it", g_.model_scale),
          Severity::Info)
          .measured = g_.model_scale;
    }
    positive(rules::weight_gradations, 16, g_.weight_gradations, 1);
    if (!(g_.max_line_width > 0)) say(rules::max_line_width, 17, "the width of the thickest line is not given");
  }

  void positive(const Rule& rule, int parameter, int& value, int fallback) {
    if (value > 0) return;
    say(rule, parameter, fmt::format("field {} is {}; {} is used", parameter, value, fallback)).measured = value;
    value = fallback;
  }

  void judge_units() {
    const int named = flag_of_name(g_.unit_name);
    if (g_.unit_flag < 1 || g_.unit_flag > 11) {
      say(rules::units_flag, 14, fmt::format("the unit flag is {}; millimetres are assumed", token_text(14))).measured =
          g_.unit_flag;
      g_.unit_flag = 2;
      g_.unit_known = false;
    } else if (g_.unit_flag == 3) {
      if (named) return;
      say(rules::units_custom, 15,
          fmt::format("the unit is '{}', which is not known; millimetres are assumed", printable(g_.unit_name, 40)));
      g_.unit_known = false;
    } else if (!g_.unit_name.empty() && named != g_.unit_flag) {
      say(rules::units_name, 15,
          fmt::format("the unit flag is {} but the unit is called '{}'; the flag is followed", g_.unit_flag,
                      printable(g_.unit_name, 40)));
    }
  }

  void judge_rest() {
    judge_date(18, g_.date);
    judge_date(25, g_.modified);
    if (is_date(g_.date) && is_date(g_.modified) && full_date(g_.modified) > full_date(g_.date))
      say(rules::date_order, 25,
          fmt::format("the model changed on {}, after the file was written on {}", g_.modified, g_.date));
    judge_resolution();
    if (g_.version_flag < 1 || g_.version_flag > 11) {
      const int effective = g_.version_flag < 1 ? 3 : 11;
      say(rules::version_flag, 23, fmt::format("the version flag is {}; {} is used", g_.version_flag, effective))
          .measured = g_.version_flag;
      g_.version_flag = effective;
    }
    if (g_.drafting_standard < 0 || g_.drafting_standard > 7) {
      say(rules::drafting_flag, 24, fmt::format("the drafting standard is {}; 0 is used", g_.drafting_standard))
          .measured = g_.drafting_standard;
      g_.drafting_standard = 0;
    }
    if (g_.sender_product.empty() || g_.file_name.empty() || g_.native_system.empty() || g_.author.empty() ||
        g_.organization.empty())
      say(rules::provenance_empty, 0, "sender, file name, system, author or organisation is empty");
  }

  void judge_date(int parameter, const std::string& date) {
    if (!date.empty() && !is_date(date))
      say(rules::date_format, parameter, fmt::format("'{}' is no date", printable(date, 40)));
  }

  void judge_resolution() {
    if (!(g_.resolution > 0)) {
      say(rules::resolution_missing, 19, fmt::format("the resolution is {}; 0.001 mm is used", token_text(19)));
      g_.resolution = 0;
      return;
    }
    const double mm = g_.resolution * unit_in_mm(g_) / g_.model_scale;
    if (mm >= 1e-9 && mm <= 0.1) return;
    Diagnostic& d =
        say(rules::resolution_implausible, 19, fmt::format("the resolution is {} mm; 0.001 mm is used", mm));
    d.measured = mm;
    d.limit = mm > 0.1 ? 0.1 : 1e-9;
  }

  // -- findings

  std::string token_text(std::size_t n) const {
    return field(n) ? fmt::format("'{}'", printable(field(n)->text, 40)) : "not given";
  }

  Diagnostic& say(const Rule& rule, int parameter, std::string text) {
    return say(rule, parameter, std::move(text), rule.severity);
  }
  Diagnostic& say(const Rule& rule, int parameter, std::string text, Severity severity) {
    Diagnostic& d = report_.add(rule, severity, std::move(text));
    const auto& section = cards_.global.cards;
    const auto n = static_cast<std::size_t>(parameter);
    const Token* token = parameter >= 3 && n < tokens_.size() ? &tokens_[n] : nullptr;
    d.location.offset = offset_in_file(section.data(), section.size(), global_columns, token ? token->offset : 0);
    d.location.length = token ? token->text.size() : 0;
    if (parameter > 0) d.parameter = parameter;
    return d;
  }

  const Cards& cards_;
  Report& report_;
  std::string text_;
  std::vector<Token> tokens_;
  Global g_;
};

}  // namespace

// The first name of a flag in the table is the one that field 15 of the standard has.
std::string_view unit_name_of_flag(int flag) {
  for (const UnitName& unit : unit_names)
    if (unit.flag == flag) return unit.name;
  return {};
}

Global read_global(const Cards& cards, Report& report) { return GlobalReader(cards, report).read(); }

std::string_view version_name(int version_flag) {
  constexpr std::array<std::string_view, 12> names = {"",
                                                      "1.0",
                                                      "ANSI Y14.26M-1981",
                                                      "2.0",
                                                      "3.0",
                                                      "ASME/ANSI Y14.26M-1987",
                                                      "4.0",
                                                      "ASME Y14.26M-1989",
                                                      "5.0",
                                                      "5.1",
                                                      "5.2",
                                                      "5.3"};
  const auto index = static_cast<std::size_t>(version_flag);
  return version_flag >= 1 && index < names.size() ? names[index] : "";
}

double unit_in_mm(const Global& global) {
  if (!global.unit_known) return 1;
  return mm_of_flag(global.unit_flag == 3 ? flag_of_name(global.unit_name) : global.unit_flag);
}

double resolution_in_mm(const Global& global) {
  const double mm = global.resolution * unit_in_mm(global) / global.model_scale;
  return mm >= 1e-9 && mm <= 0.1 ? mm : 0.001;
}

}  // namespace trimloop::iges
