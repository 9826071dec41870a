/// A reader that does what a file might make a reader do. Every task answers with what it got.
#include <arpa/inet.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iostream>
#include <sstream>
#include <thread>
#include <vector>

#include "core/error.hpp"
#include "isolation/reader_service.hpp"

namespace {

using nlohmann::json;
namespace fs = std::filesystem;

std::string outcome(long result) { return result < 0 ? std::strerror(errno) : "done"; }

std::string text_of(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

json read_input(const fs::path& input, const json&, const ream::Progress& progress) {
  progress(0.5, "half\nway");
  std::ofstream("copy") << text_of(input);
  std::vector<std::string> below;
  if (fs::is_directory(input))
    for (const auto& entry : fs::directory_iterator(input)) below.push_back(entry.path().filename());
  return {{"text", text_of(input)}, {"below", below}};
}

/// Opens, makes or removes what the options name.
json reach(const fs::path&, const json& options, const ream::Progress&) {
  const std::string path = options.at("path");
  json told;
  told["read"] = outcome(::open(path.c_str(), O_RDONLY));
  told["write"] = outcome(::open(path.c_str(), O_WRONLY));
  told["create"] = outcome(::open((path + ".new").c_str(), O_WRONLY | O_CREAT, 0600));
  told["remove"] = outcome(::unlink(path.c_str()));
  told["link"] = outcome(::symlink(path.c_str(), "link"));
  return told;
}

json call(const fs::path&, const json& options, const ream::Progress&) {
  const auto network = [](int family, int type) { return outcome(::socket(family, type, 0)); };
  char name[] = "/bin/true";
  char* const arguments[] = {name, nullptr};
  json told{{"tcp", network(AF_INET, SOCK_STREAM)},
            {"udp", network(AF_INET6, SOCK_DGRAM)},
            {"unix", network(AF_UNIX, SOCK_STREAM)}};
  told["fork"] = outcome(::fork());
  told["exec"] = outcome(::execv(name, arguments));
  told["signal"] = outcome(::kill(options.at("parent").get<int>(), SIGUSR1));
  void* const memory =
      ::mmap(nullptr, 4096, PROT_READ | PROT_WRITE | PROT_EXEC, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  told["code"] = outcome(memory == MAP_FAILED ? -1 : 0);
  told["descriptors"] = json::array();
  for (int descriptor = 7; descriptor < 60; ++descriptor)
    if (::fcntl(descriptor, F_GETFD) >= 0) told["descriptors"].push_back(descriptor);
  told["environment"] = ::environ[0] == nullptr ? "empty" : "not empty";
  int sum = 0;
  std::thread([&sum] { sum = 7; }).join();
  told["thread"] = sum;
  return told;
}

json take_memory(const fs::path&, const json&, const ream::Progress&) {
  std::vector<std::vector<char>> kept;
  while (true) kept.emplace_back(16 << 20, 'x');
}

json take_disk(const fs::path&, const json&, const ream::Progress&) {
  std::ofstream out("large");
  const std::string piece(1 << 20, 'x');
  while (out << piece) {
  }
  return {};
}

json spin(const fs::path&, const json&, const ream::Progress&) {
  while (true) [[maybe_unused]] const auto now = std::chrono::steady_clock::now();
}

json sleep_long(const fs::path&, const json&, const ream::Progress&) {
  while (true) std::this_thread::sleep_for(std::chrono::seconds(1));
}

json crash(const fs::path&, const json& options, const ream::Progress&) {
  if (options.at("how") == "abort") std::abort();
  if (options.at("how") == "exit") std::_Exit(0);
  if (options.at("how") == "throw") throw std::runtime_error("a library\ngave up");
  volatile int* nowhere = nullptr;
  *nowhere = 1;
  return {};
}

/// Answers of its own, past the service.
json answer_oddly(const fs::path&, const json& options, const ream::Progress&) {
  std::string text = options.at("text");
  const size_t times = options.at("times");
  for (size_t i = 0; i < times; ++i)
    if (::write(ream::isolation::answer_descriptor, text.data(), text.size()) < 0) break;
  std::_Exit(0);
}

}  // namespace

int main() {
  ream::isolation::serve_one_job({{"read", read_input},
                                  {"reach", reach},
                                  {"call", call},
                                  {"take_memory", take_memory},
                                  {"take_disk", take_disk},
                                  {"spin", spin},
                                  {"sleep", sleep_long},
                                  {"crash", crash},
                                  {"answer_oddly", answer_oddly}});
}
