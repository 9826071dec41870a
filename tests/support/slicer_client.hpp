#pragma once
#include <chrono>
#include <functional>
#include <memory>
#include <vector>

#include "support/igtl_reading.hpp"

namespace ream::test {

/// What Debian's OpenIGTLink library, with which 3D Slicer reads too, makes of one message. Throws
/// std::runtime_error where it refuses.
IgtlReading read_by_library(const IgtlBytes& message);

/// A client as 3D Slicer's OpenIGTLinkIF is one: it connects, and takes messages as they come, by the
/// library's sockets.
class SlicerClient {
 public:
  /// Throws std::runtime_error when nobody listens there.
  explicit SlicerClient(uint16_t port);
  ~SlicerClient();

  /// The next message, as it came over the wire; throws when none comes within two minutes or the line ends.
  IgtlBytes next();
  /// The next `bytes` of the wire, whatever they are.
  IgtlBytes raw(size_t bytes);
  /// Sends these.
  void say(const IgtlBytes& bytes);
  /// Takes messages, read by both readers (std::runtime_error when they disagree), until one is `wanted`;
  /// throws after two minutes.
  IgtlReading hear_until(const std::string& what, const std::function<bool(const IgtlReading&)>& wanted);
  /// Until one has this name.
  IgtlReading hear(const std::string& name) {
    return hear_until(name, [&](const IgtlReading& reading) { return reading.name == name; });
  }

 private:
  struct Line;
  std::unique_ptr<Line> line_;
};

}  // namespace ream::test
