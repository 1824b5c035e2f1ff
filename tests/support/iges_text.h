#pragma once
// Small IGES files composed from text, right by default, with every card open to damage. Independent of the library's own
// writer on purpose: a fault there must not hide one in the reader.
//
//   IgesText file;
//   int line = file.add(110, "0.,0.,0.,1.,0.,0.");          // its directory pointer
//   file.add(402, "1,{}", {.form = 7}, {line});             // each {} is replaced by a pointer
//   std::string bytes = file.text();

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace trimloop::test {

struct IgesEntity {
  int type = 0;
  std::string parameters = {};  // without the type and without the record delimiter
  int form = 0;
  std::string status = "00000000";
  int transform = 0, colour = 0, level = 0, line_font = 0, view = 0, line_weight = 0;
  std::string label = {};
  std::string comment = {};  // put behind the record delimiter
};

struct IgesOptions {
  int form = 0;
  std::string status = "00000000";
  int transform = 0, colour = 0, level = 0;
  std::string label = {};
};

class IgesText {
 public:
  std::vector<std::string> start = {"trimloop test file"};
  // Fields 3 to 26, with commas; unit 2 is mm. The delimiters stand before it.
  std::string global =
      "4Htest,8Htest.igs,8Htrimloop,8Htrimloop,32,38,6,308,15,4Htest,1.,2,2HMM,1,1.,15H20260101.000000,1.E-6,1000.,"
      "6Hauthor,3Horg,11,0,15H20260101.000000,";
  char parameter_delimiter = ',', record_delimiter = ';';

  int add(IgesEntity entity);  // the directory pointer
  int add(int type, std::string_view parameters, IgesOptions options = {}, std::initializer_list<int> pointers = {});

  std::vector<std::string> cards() const;                 // 80 columns each, without line ends
  std::string text(std::string_view line_end = "\n") const;
  std::vector<IgesEntity> entities;
};

// One card: data in columns 1-72, then the section letter and the sequence number.
std::string iges_card(std::string_view data, char section, std::size_t sequence);
std::string join_cards(const std::vector<std::string>& cards, std::string_view line_end = "\n");
std::string hollerith(std::string_view text);  // "3Habc"

}  // namespace trimloop::test
