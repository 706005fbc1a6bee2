// Reads words and numbers from the text of a file, and knows the line for the message when something is wrong.
// Numbers are parsed with std::from_chars: exactly rounded, and the same in every locale.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace starcell {

class TextScanner {
 public:
  /// `name` of the file, for messages. Both must outlive the scanner.
  TextScanner(std::string_view text, const std::string& name, std::size_t start = 0) : text_(text), name_(&name), at_(start) {}

  /// A backslash at the end of a line joins the next line to it (OBJ).
  void join_lines() { joins_lines_ = true; }

  /// Moves on to the next word, over line ends and #-comments. False at the end of the text.
  bool find_word();
  /// Moves on to the next word of this line. False at its end, at a comment, and at the end of the text.
  bool find_word_in_line();
  /// To the first character of the next line.
  void skip_line();

  /// The word at this place; empty at the end of the text. Moves behind it.
  std::string_view word();
  /// The next word, anywhere, as a number. "nan" and "inf" are numbers; a leading + is allowed.
  double number();
  /// The next word, anywhere, as an integer.
  std::int64_t integer();
  /// Parses the integer that a word begins with (OBJ's "7/1/2") and leaves the rest in `word`.
  std::int64_t leading_integer(std::string_view& word) const;

  std::size_t position() const { return at_; }
  std::size_t remaining() const { return text_.size() - at_; }
  std::size_t line() const;

  /// Throws FileError: "name, line 7: reason".
  [[noreturn]] void fail(const std::string& reason) const;

 private:
  bool line_end_is_joined() const;

  std::string_view text_;
  const std::string* name_;
  std::size_t at_;
  bool joins_lines_ = false;
};

/// The word in quotes, shortened, with unprintable bytes replaced: fit for a message.
std::string quoted(std::string_view word);

/// Are the two the same but for upper and lower case (ASCII)? `lower` must be in lower case.
bool is_word(std::string_view word, std::string_view lower);

}  // namespace starcell
