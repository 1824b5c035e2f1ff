#include "formats/step/write.h"

#include <algorithm>
#include <cmath>

#include "base/number.h"
#include "formats/step/strings.h"

namespace trimloop::step {

void Attributes21::put(double value) {
  finite_ = finite_ && std::isfinite(value);
  text_ += std::isfinite(value) ? step_real(value) : "0.";
}
void Attributes21::put(bool value) { text_ += value ? ".T." : ".F."; }
void Attributes21::put(std::int64_t value) { text_ += std::to_string(value); }
void Attributes21::put(std::string_view text) { text_ += encode_string(text); }
void Attributes21::put(InstanceId id) {
  if (!id) return put(Unset{});
  text_ += '#';
  text_ += std::to_string(id.number);
}
void Attributes21::put(Enumeration value) {
  text_ += '.';
  text_ += value.word;
  text_ += '.';
}
void Attributes21::put(const Measure& value) {
  text_ += value.type;
  text_ += '(';
  put(value.value);
  text_ += ')';
}
void Attributes21::put(const TrimSelect& value) {
  text_ += '(';
  put(value.point);
  text_ += ',';
  put(Measure{"PARAMETER_VALUE", value.parameter});
  text_ += ')';
}
void Attributes21::put(const TypedText& value) {
  text_ += value.type;
  text_ += '(';
  put(value.text);
  text_ += ')';
}
void Attributes21::put(const TypedEnumeration& value) {
  text_ += value.type;
  text_ += '(';
  put(Enumeration{value.word});
  text_ += ')';
}

Writer::Writer(const FileHeader& h) {
  const auto line = [&](std::string_view keyword, const Attributes21& attributes) {
    text_ += keyword;
    text_ += attributes.text();
    text_ += ";\n";
  };
  using List = std::vector<std::string>;
  text_ = "ISO-10303-21;\nHEADER;\n";
  line("FILE_DESCRIPTION", Attributes21::of(List{h.description}, h.level));
  line("FILE_NAME", Attributes21::of(h.name, h.time_stamp, List{h.author}, List{h.organization}, h.preprocessor, h.system,
                                     h.authorization));
  line("FILE_SCHEMA", Attributes21::of(List{h.schema}));
  text_ += "ENDSEC;\nDATA;\n";
}

InstanceId Writer::begin() {
  text_ += '#';
  text_ += std::to_string(++last_);
  text_ += '=';
  return {last_};
}

InstanceId Writer::append(std::string_view keyword, const Attributes21& attributes) {
  const InstanceId id = begin();
  if (!attributes.finite() && not_finite_ == 0) not_finite_ = id.number;
  text_ += keyword;
  text_ += attributes.text();
  text_ += ";\n";
  return id;
}

InstanceId Writer::append_shared(std::string_view keyword, const Attributes21& attributes) {
  std::string key(keyword);
  key += attributes.text();
  const auto [at, fresh] = shared_.try_emplace(std::move(key), 0);
  if (fresh) at->second = append(keyword, attributes).number;
  return {at->second};
}

InstanceId Writer::add_complex(std::vector<Partial> parts) {
  std::stable_sort(parts.begin(), parts.end(), [](const Partial& a, const Partial& b) { return a.keyword < b.keyword; });
  const InstanceId id = begin();
  text_ += '(';
  for (const Partial& part : parts) {
    if (!part.attributes.finite() && not_finite_ == 0) not_finite_ = id.number;
    text_ += part.keyword;
    text_ += part.attributes.text();
  }
  text_ += ");\n";
  return id;
}

InstanceId Writer::add_copy(std::string_view value) {
  const InstanceId id = begin();
  text_ += value;
  text_ += ";\n";
  return id;
}

Result<std::string> Writer::finish() const {
  if (not_finite_) {
    return fail(ErrorCode::InvalidArgument,
                "a number that is not finite would have been written in #" + std::to_string(not_finite_));
  }
  return text_ + "ENDSEC;\nEND-ISO-10303-21;\n";
}

}  // namespace trimloop::step
