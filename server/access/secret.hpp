#pragma once
#include <string>
#include <string_view>

namespace ream::access {

/// Text that nobody else may see: a password, a token. It cannot be printed or turned into JSON by accident,
/// and its memory is wiped when it goes.
class Secret {
 public:
  Secret() = default;
  /// Takes the text over and wipes what it came in.
  explicit Secret(std::string&& text) noexcept;
  explicit Secret(std::string_view text) : text_(text) {}
  Secret(const Secret&) = default;
  Secret(Secret&& other) noexcept : Secret(std::move(other.text_)) {}
  Secret& operator=(const Secret& other);
  Secret& operator=(Secret&& other) noexcept;
  ~Secret();

  /// For hashing, comparing and handing it to its owner; never for a log, an error or a file.
  const std::string& reveal() const { return text_; }
  bool empty() const { return text_.empty(); }

 private:
  std::string text_;
};

/// Overwrites all that the string has held, and empties it.
void wipe(std::string& text) noexcept;

/// Takes as long whatever the texts hold, if they are equally long.
bool equal_in_constant_time(std::string_view a, std::string_view b);

}  // namespace ream::access
