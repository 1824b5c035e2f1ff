#pragma once
// Colours, visibility and layers by the instance they are given to. ISO 10303-46.

#include "io/step/context.h"

namespace trimloop::io::step_import {

class Styles {
 public:
  // Reads every style, layer and invisibility of the file once; layers get numbers in `model`.
  Styles(Context& context, Model& model);

  // What the file says about this instance itself; nothing said: the defaults.
  Attributes of(const Record& instance) const;
  bool has(const Record& instance) const { return by_item_.count(context_.index(instance)) > 0; }

 private:
  void read_style(const Record& styled, bool overriding);
  const Record* target(const Record& styled);
  std::optional<Colour> colour_of(const Record& style, int depth, bool surface);
  std::optional<Colour> colour(const Record& instance);

  Context& context_;
  struct Own {
    std::optional<Colour> colour;
    bool overriding = false;
    int layer = 0;
    bool visible = true;
  };
  std::unordered_map<std::size_t, Own> by_item_;
  std::unordered_map<std::size_t, std::optional<Colour>> by_style_;
};

// Attributes of a part of something: its own word counts, else its owner's. What is inside something hidden is hidden.
Attributes under(const Attributes& owner, Attributes own);

}  // namespace trimloop::io::step_import
