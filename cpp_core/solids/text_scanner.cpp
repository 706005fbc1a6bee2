// A cursor over the text. The line number is counted only when an error needs it.
#include "solids/text_scanner.h"

#include <algorithm>
#include <charconv>

#include "solids/errors.h"

namespace starcell {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }
bool is_space(char c) { return c == '\n' || is_blank(c); }

}  // namespace

bool TextScanner::line_end_is_joined() const {
  if (!joins_lines_ || text_[at_] != '\\') return false;
  const std::size_t next = text_.find_first_not_of('\r', at_ + 1);
  return next == std::string_view::npos || text_[next] == '\n';
}

bool TextScanner::find_word() {
  while (at_ < text_.size()) {
    if (is_space(text_[at_]) || line_end_is_joined()) ++at_;
    else if (text_[at_] == '#') skip_line();
    else return true;
  }
  return false;
}

bool TextScanner::find_word_in_line() {
  while (at_ < text_.size()) {
    if (is_blank(text_[at_])) ++at_;
    else if (line_end_is_joined()) at_ = std::min(text_.find('\n', at_), text_.size() - 1) + 1;
    else return text_[at_] != '\n' && text_[at_] != '#';
  }
  return false;
}

void TextScanner::skip_line() {
  // A joined line ends where its last piece ends, also in a comment.
  for (;;) {
    const std::size_t end = text_.find('\n', at_);
    if (end == std::string_view::npos) {
      at_ = text_.size();
      return;
    }
    std::size_t last = end;
    while (last > at_ && text_[last - 1] == '\r') --last;
    const bool joined = joins_lines_ && last > at_ && text_[last - 1] == '\\';
    at_ = end + 1;
    if (!joined) return;
  }
}

std::string_view TextScanner::word() {
  const std::size_t begin = at_;
  while (at_ < text_.size() && !is_space(text_[at_]) && text_[at_] != '#' && !line_end_is_joined()) ++at_;
  return text_.substr(begin, at_ - begin);
}

double TextScanner::number() {
  if (!find_word()) fail("the file ends where a number should be");
  const std::size_t begin = at_;
  const std::string_view text = word();
  const char* first = text.data();
  const char* last = first + text.size();
  if (text.size() > 1 && first[0] == '+' && first[1] != '-') ++first;
  double value = 0.0;
  const auto [end, error] = std::from_chars(first, last, value);
  if (error != std::errc() || end != last) {
    at_ = begin;
    fail(quoted(text) + (error == std::errc::result_out_of_range ? " is out of the range of numbers" : " is not a number"));
  }
  return value;
}

std::int64_t TextScanner::leading_integer(std::string_view& word) const {
  std::size_t sign = word.size() > 1 && word[0] == '+' && word[1] != '-';
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(word.data() + sign, word.data() + word.size(), value);
  if (error != std::errc()) fail(quoted(word) + " is not a whole number of a sensible size");
  word.remove_prefix(end - word.data());
  return value;
}

std::int64_t TextScanner::integer() {
  if (!find_word()) fail("the file ends where a whole number should be");
  const std::size_t begin = at_;
  const std::string_view text = word();
  std::string_view rest = text;
  const std::int64_t value = leading_integer(rest);
  if (!rest.empty()) {
    at_ = begin;
    fail(quoted(text) + " is not a whole number");
  }
  return value;
}

std::size_t TextScanner::line() const {
  return 1 + std::count(text_.begin(), text_.begin() + std::min(at_, text_.size()), '\n');
}

void TextScanner::fail(const std::string& reason) const {
  throw FileError(*name_ + ", line " + std::to_string(line()) + ": " + reason + ".");
}

std::string quoted(std::string_view word) {
  std::string text = "'";
  for (char c : word.substr(0, 40)) text += c >= ' ' && c <= '~' ? c : '?';
  return text + (word.size() > 40 ? "...'" : "'");
}

bool is_word(std::string_view word, std::string_view lower) {
  return std::equal(word.begin(), word.end(), lower.begin(), lower.end(),
                    [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a - 'A' + 'a' : a) == b; });
}

}  // namespace starcell
