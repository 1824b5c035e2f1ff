#include "formats/iges/write.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "base/number.h"
#include "formats/iges/card_writer.h"

namespace trimloop::iges {

// ---- Cards

namespace {

// Right-justified in columns of a card; what does not fit loses its head (the limits see to it that all fits).
void put_right(std::int64_t value, char* columns, std::size_t width) {
  char digits[20];
  const auto count = static_cast<std::size_t>(std::to_chars(digits, digits + sizeof digits, value).ptr - digits);
  const std::size_t kept = std::min(count, width);
  std::fill_n(columns, width - kept, ' ');
  std::copy_n(digits + count - kept, kept, columns + width - kept);
}

}  // namespace

CardWriter::CardWriter(char section, std::size_t width, std::size_t limit) : width_(width), limit_(limit) {
  card_.fill(' ');
  card_[72] = section;
  card_[80] = '\n';
}

void CardWriter::set_back_pointer(std::int64_t de) { put_right(de, card_.data() + width_, 72 - width_); }

void CardWriter::token(std::string_view text) {
  if (filled_ + text.size() > width_ && filled_ > 0) end_card();
  while (text.size() > width_) {
    put(text.substr(0, width_));
    text.remove_prefix(width_);
    end_card();
  }
  put(text);
}

void CardWriter::token(std::string_view text, char delimiter) {
  if (text.size() < width_) {
    if (filled_ + text.size() + 1 > width_) end_card();
    put(text);
    card_[filled_++] = delimiter;
    return;
  }
  token(std::string(text) + delimiter);
}

void CardWriter::put(std::string_view text) {
  std::copy(text.begin(), text.end(), card_.data() + filled_);
  filled_ += text.size();
}

void CardWriter::line(std::string_view data) {
  end_card();
  token(data.empty() ? std::string_view(" ") : data);
  end_card();
}

void CardWriter::end_card() {
  if (filled_ == 0) return;
  if (cards_ == limit_) full_ = true;
  if (!full_) {
    std::fill(card_.data() + filled_, card_.data() + width_, ' ');
    put_right(static_cast<std::int64_t>(++cards_), card_.data() + 73, 7);
    constexpr std::size_t block = 800;  // cards: 65 kB
    if (blocks_.empty() || blocks_.back().size() == block * card_.size()) blocks_.emplace_back().reserve(block * card_.size());
    blocks_.back().append(card_.data(), card_.size());
  }
  filled_ = 0;
}

void CardWriter::append_to(std::string& out) const {
  for (const std::string& block : blocks_) out += block;
}

// ---- Files

namespace {

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == '\x7f'; }

bool has_controls(std::string_view text) {
  bool found = false;
  for (char c : text) found |= is_control(c);  // without a way out, so that it is done 16 at a time
  return found;
}
bool has_controls(const TokenWriter& tokens) { return has_controls(tokens.text()); }
bool has_controls(const std::vector<std::string>& tokens) {
  return std::any_of(tokens.begin(), tokens.end(), [](const std::string& t) { return has_controls(std::string_view(t)); });
}

std::string printable_string(std::string text) {
  std::replace_if(text.begin(), text.end(), is_control, ' ');
  return text;
}

std::string hollerith(const std::string& text) {
  return text.empty() ? "" : fmt::format("{}H{}", text.size(), printable_string(text));
}

std::string real_or_empty(double value) { return value == 0 || !std::isfinite(value) ? "" : iges_real(value); }

bool may_delimit(char c) {
  return c > ' ' && c < '\x7f' && std::string_view("0123456789+-.DEH").find(c) == std::string_view::npos;
}

// One Directory field, eight columns.
std::optional<std::string> directory_field(std::int64_t value) {
  std::string text = fmt::format("{:>8}", value);
  return text.size() == 8 ? std::optional(text) : std::nullopt;
}

}  // namespace

struct Writer::Impl {
  Impl(Global g, std::size_t most_cards)
      : global(std::move(g)), start('S', 72, most_cards), directory('D', 72, most_cards), parameters('P', 64, most_cards) {}

  Global global;
  CardWriter start, directory, parameters;
  std::size_t count = 0;
  std::optional<Error> refused;  // the first reason why there can be no file

  void refuse(std::string text) {
    if (!refused) refused = Error{ErrorCode::InvalidArgument, std::move(text)};
  }
  template <class Tokens>
  Ref add(DirectoryEntry&& entry, const Tokens& tokens, const TrailingGroups& groups);
  template <class Tokens>
  void write_parameters(std::int64_t de, int type, const Tokens& tokens, const TrailingGroups& groups);
  void write_directory(const DirectoryEntry& entry);
  CardWriter global_cards() const;
};

Writer::Writer(Global global, std::vector<std::string> start_lines, std::size_t most_cards)
    : impl_(std::make_unique<Impl>(std::move(global), most_cards)) {
  if (start_lines.empty()) start_lines.emplace_back();
  for (std::string& line : start_lines) impl_->start.line(printable_string(std::move(line)));
  const char pd = impl_->global.parameter_delimiter, rd = impl_->global.record_delimiter;
  if (!may_delimit(pd) || !may_delimit(rd) || pd == rd)
    impl_->refuse("the two delimiters must be different and no part of a number");
}

Writer::Writer(Writer&&) noexcept = default;
Writer::~Writer() = default;

std::size_t Writer::entities() const { return impl_->count; }

template <class Tokens>
Ref Writer::Impl::add(DirectoryEntry&& entry, const Tokens& tokens, const TrailingGroups& groups) {
  entry.de = static_cast<std::int32_t>(std::min<std::size_t>(2 * count + 1, CardWriter::most_cards));
  entry.parameter_pointer = static_cast<int>(parameters.cards() + 1);
  write_parameters(entry.de, entry.type, tokens, groups);
  entry.parameter_count = static_cast<int>(parameters.cards() + 1) - entry.parameter_pointer;
  write_directory(entry);
  ++count;
  return Ref{entry.de};
}

Ref Writer::add(DirectoryEntry entry, const std::vector<std::string>& tokens, const TrailingGroups& groups) {
  return impl_->add(std::move(entry), tokens, groups);
}

Ref Writer::add(DirectoryEntry entry, const TokenWriter& tokens, const TrailingGroups& groups) {
  return impl_->add(std::move(entry), tokens, groups);
}

template <class Tokens>
void Writer::Impl::write_parameters(std::int64_t de, int type, const Tokens& tokens, const TrailingGroups& groups) {
  TokenWriter tail;
  if (!groups.associativities.empty() || !groups.properties.empty()) tail.trailing_groups(groups);
  parameters.set_back_pointer(de);
  const bool controls = has_controls(tokens);
  std::size_t left = tokens.size() + tail.size();
  const auto put = [&](std::string_view token) {
    const char delimiter = left-- == 0 ? global.record_delimiter : global.parameter_delimiter;
    if (controls) parameters.token(printable_string(std::string(token)), delimiter);
    else parameters.token(token, delimiter);
  };
  put(std::to_string(type));
  for (std::size_t i = 0; i < tokens.size(); ++i) put(tokens[i]);
  for (std::size_t i = 0; i < tail.size(); ++i) put(tail[i]);
  parameters.end_card();
}

void Writer::Impl::write_directory(const DirectoryEntry& e) {
  const Status& s = e.status;
  for (int part : {s.blank, s.subordinate, s.use, s.hierarchy})
    if (part < 0 || part > 99) return refuse(fmt::format("D{}: a status of {} has no two digits", e.de, part));
  std::string label = printable_string(e.label);
  label.resize(std::min<std::size_t>(8, label.size()));
  label.insert(0, 8 - label.size(), ' ');

  std::string cards[2];
  for (std::int64_t value :
       {e.type, e.parameter_pointer, e.structure, e.line_font, e.level, e.view, e.transform, e.label_display}) {
    const auto field = directory_field(value);
    if (!field) return refuse(fmt::format("D{}: {} does not fit into a Directory field", e.de, value));
    cards[0] += *field;
  }
  cards[0] += fmt::format("{:02}{:02}{:02}{:02}", s.blank, s.subordinate, s.use, s.hierarchy);
  for (std::int64_t value : {e.type, e.line_weight, e.colour, e.parameter_count, e.form}) {
    const auto field = directory_field(value);
    if (!field) return refuse(fmt::format("D{}: {} does not fit into a Directory field", e.de, value));
    cards[1] += *field;
  }
  const auto subscript = directory_field(e.subscript);
  if (!subscript) return refuse(fmt::format("D{}: the subscript {} does not fit into its field", e.de, e.subscript));
  cards[1] += std::string(16, ' ') + label + *subscript;
  for (const std::string& card : cards) directory.line(card);
}

// 2.2.4.3: 26 fields; what is not known stays empty.
CardWriter Writer::Impl::global_cards() const {
  const Global& g = global;
  const std::string fields[] = {fmt::format("1H{}", g.parameter_delimiter),
                                fmt::format("1H{}", g.record_delimiter),
                                hollerith(g.sender_product),
                                hollerith(g.file_name),
                                hollerith(g.native_system),
                                hollerith(g.preprocessor),
                                std::to_string(g.integer_bits),
                                std::to_string(g.single_magnitude),
                                std::to_string(g.single_significance),
                                std::to_string(g.double_magnitude),
                                std::to_string(g.double_significance),
                                hollerith(g.receiver_product),
                                real_or_empty(g.model_scale),
                                std::to_string(g.unit_flag),
                                hollerith(g.unit_name),
                                std::to_string(g.weight_gradations),
                                real_or_empty(g.max_line_width),
                                hollerith(g.date),
                                real_or_empty(g.resolution),
                                real_or_empty(g.max_coordinate),
                                hollerith(g.author),
                                hollerith(g.organization),
                                std::to_string(g.version_flag),
                                std::to_string(g.drafting_standard),
                                hollerith(g.modified),
                                hollerith(g.protocol)};
  CardWriter cards('G', 72);
  for (const std::string& field : fields)
    cards.token(field + (&field == std::end(fields) - 1 ? g.record_delimiter : g.parameter_delimiter));
  cards.end_card();
  return cards;
}

Result<std::string> Writer::finish() const {
  const Impl& from = *impl_;
  if (from.refused) return tl::unexpected<Error>(*from.refused);
  const CardWriter global = from.global_cards();
  for (const CardWriter* section : {&from.start, &global, &from.directory, &from.parameters})
    if (section->full())
      return fail(ErrorCode::Limit, "a section would need more cards than seven digits can count",
                  static_cast<double>(section->cards()) + 1, static_cast<double>(from.parameters.limit()));
  CardWriter terminate('T', 72);
  terminate.line(fmt::format("S{:>7}G{:>7}D{:>7}P{:>7}", from.start.cards(), global.cards(), from.directory.cards(),
                             from.parameters.cards()));
  std::string out;
  const CardWriter* const sections[] = {&from.start, &global, &from.directory, &from.parameters, &terminate};
  std::size_t size = 0;
  for (const CardWriter* section : sections) size += section->size();
  out.reserve(size);
  for (const CardWriter* section : sections) section->append_to(out);
  return out;
}

}  // namespace trimloop::iges
