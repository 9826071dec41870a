#include "app/password_prompt.hpp"

#include <termios.h>
#include <unistd.h>

#include <cstdio>
#include <iostream>

#include "core/error.hpp"

namespace ream::app {
namespace {

constexpr char interrupt = 0x03, end_of_input = 0x04, backspace = 0x08, erase_line = 0x15, rub_out = 0x7f;

/// The terminal gives every key at once and shows none, until this goes.
class SilentTerminal {
 public:
  SilentTerminal() {
    ::tcgetattr(STDIN_FILENO, &before_);
    termios silent = before_;
    // Ctrl-C comes as a key, so that the terminal is never left mute.
    silent.c_lflag &= ~static_cast<tcflag_t>(ECHO | ICANON | ISIG);
    silent.c_cc[VMIN] = 1;
    silent.c_cc[VTIME] = 0;
    ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &silent);
  }
  ~SilentTerminal() { ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &before_); }
  SilentTerminal(const SilentTerminal&) = delete;
  SilentTerminal& operator=(const SilentTerminal&) = delete;

 private:
  termios before_{};
};

/// The last character, which may have several bytes.
void rub_out_one(std::string& text) {
  while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xc0) == 0x80) text.pop_back();
  if (!text.empty()) text.pop_back();
}

std::string typed_line() {
  const SilentTerminal silent;
  std::string text;
  for (char key = 0; ::read(STDIN_FILENO, &key, 1) == 1;) {
    if (key == '\n' || key == '\r' || key == end_of_input) break;
    if (key == interrupt) {
      access::wipe(text);
      throw Error(ErrorKind::cancelled, "nothing was changed");
    }
    if (key == rub_out || key == backspace)
      rub_out_one(text);
    else if (key == erase_line)
      text.clear();
    else
      text += key;
  }
  return text;
}

access::Secret asked(const std::string& question) {
  std::cerr << question << std::flush;
  try {
    access::Secret answer(typed_line());
    std::cerr << std::endl;
    return answer;
  } catch (const Error&) {
    std::cerr << std::endl;
    throw;
  }
}

access::Secret piped_line() {
  std::string line;
  std::getline(std::cin, line);
  if (!line.empty() && line.back() == '\r') line.pop_back();
  return access::Secret(std::move(line));
}

}  // namespace

access::Secret ask_new_password(const std::string& whose) {
  if (::isatty(STDIN_FILENO) == 0) {
    access::Secret password = piped_line();
    if (password.empty())
      throw Error(ErrorKind::invalid_input,
                  "no password on stdin; type it at a terminal or pipe one line in");
    return password;
  }
  access::Secret first = asked("Password of " + whose + ": ");
  const access::Secret second = asked("Once more: ");
  if (!access::equal_in_constant_time(first.reveal(), second.reveal()))
    throw Error(ErrorKind::invalid_input, "the two passwords differ; nothing was changed");
  return first;
}

}  // namespace ream::app
