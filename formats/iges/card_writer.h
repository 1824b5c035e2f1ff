#pragma once
// Text of one section in the making: tokens packed into the data columns of numbered cards.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace trimloop::iges {

class CardWriter {
 public:
  static constexpr std::size_t most_cards = 9'999'999;  // sequence numbers have seven digits

  // `width`: data columns, 72 or 64. Beyond `limit` cards nothing is written any more and full() tells.
  CardWriter(char section, std::size_t width, std::size_t limit = most_cards);

  // What stands in columns 65-72 of the cards from now on (Parameter section).
  void set_back_pointer(std::int64_t de);

  // Appends a token, delimiter included. It goes to the next card when it does not fit; one that fits on no card is cut.
  void token(std::string_view text);
  void token(std::string_view text, char delimiter);  // the same, the delimiter given beside it
  void line(std::string_view data);  // a card of its own, cut to several when longer
  void end_card();                   // finishes the card begun, if any

  std::size_t cards() const { return cards_; }
  std::size_t limit() const { return limit_; }
  bool full() const { return full_; }
  std::size_t size() const { return cards_ * card_.size(); }  // bytes of all finished cards
  void append_to(std::string& out) const;

 private:
  void put(std::string_view text);  // onto the card begun, where it fits

  std::size_t width_, limit_, cards_ = 0, filled_ = 0;
  bool full_ = false;
  std::array<char, 81> card_;  // the one begun, its end of line included
  std::vector<std::string> blocks_;  // of finished cards: one long text would be copied each time that it grows
};

}  // namespace trimloop::iges
