#include "config/json_line.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace gyrocal {
namespace {

/// Walks valid JSON and notes the line of the deepest value on the way to the pointer.
class Walk {
 public:
  Walk(std::string_view text, std::string_view pointer) : text_(text) {
    while (!pointer.empty()) {
      pointer.remove_prefix(1);
      const std::size_t end = std::min(pointer.find('/'), pointer.size());
      wanted_.push_back(pointer.substr(0, end));
      pointer.remove_prefix(end);
    }
  }

  int find() {
    value(0, true);
    return found_line_;
  }

 private:
  /// Reads one value; `on_way`: it lies on the path, `depth` names of which are matched.
  void value(std::size_t depth, bool on_way) {
    space();
    if (on_way && depth >= found_depth_) {
      found_depth_ = depth;
      found_line_ = line_;
    }
    if (peek() == '{') return members(depth, on_way);
    if (peek() == '[') return elements(depth, on_way);
    if (peek() == '"') {
      string();
      return;
    }
    while (at_ < text_.size() && std::string_view(",]} \t\r\n").find(text_[at_]) == text_.npos) {
      ++at_;
    }
  }

  void members(std::size_t depth, bool on_way) {
    ++at_;
    for (space(); at_ < text_.size() && peek() != '}'; space()) {
      const std::string_view key = string();
      space();
      ++at_;  // the colon
      value(depth + 1, on_way && depth < wanted_.size() && key == wanted_[depth]);
      space();
      if (peek() == ',') ++at_;
    }
    ++at_;
  }

  void elements(std::size_t depth, bool on_way) {
    ++at_;
    std::size_t index = 0;
    for (space(); at_ < text_.size() && peek() != ']'; space()) {
      const bool match =
          on_way && depth < wanted_.size() && std::to_string(index) == wanted_[depth];
      value(depth + 1, match);
      ++index;
      space();
      if (peek() == ',') ++at_;
    }
    ++at_;
  }

  std::string_view string() {
    const std::size_t begin = ++at_;
    while (at_ < text_.size() && text_[at_] != '"') at_ += text_[at_] == '\\' ? 2 : 1;
    const std::string_view inside = text_.substr(begin, at_ - begin);
    ++at_;
    return inside;
  }

  void space() {
    while (at_ < text_.size() && std::string_view(" \t\r\n").find(text_[at_]) != text_.npos) {
      line_ += text_[at_] == '\n';
      ++at_;
    }
  }

  char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }

  std::string_view text_;
  std::vector<std::string_view> wanted_;
  std::size_t at_ = 0;
  int line_ = 1;
  int found_line_ = 1;
  std::size_t found_depth_ = 0;
};

}  // namespace

int json_line(std::string_view text, std::string_view pointer) {
  return Walk(text, pointer).find();
}

}  // namespace gyrocal
