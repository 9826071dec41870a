#pragma once
#include <sys/types.h>

#include <cstddef>
#include <functional>

namespace ream::bench {

/// A process of its own beside the one that measures, with a pipe each way. Made before the program starts
/// threads, as it is a fork. Ends with its owner.
class SideProcess {
 public:
  /// What the process does, with the ends of the pipes to read from and write to; it ends when this returns.
  using Work = std::function<void(int in, int out)>;

  explicit SideProcess(const Work& work);
  ~SideProcess();
  SideProcess(const SideProcess&) = delete;
  SideProcess& operator=(const SideProcess&) = delete;

  /// Plain data of one type, as a whole. Error unavailable when the process has ended.
  template <typename Data>
  void send(const Data& data) const {
    send_bytes(&data, sizeof data);
  }
  template <typename Data>
  Data receive() const {
    Data data;
    receive_bytes(&data, sizeof data);
    return data;
  }

 private:
  void send_bytes(const void* from, size_t bytes) const;
  void receive_bytes(void* into, size_t bytes) const;

  int to_child_ = -1, from_child_ = -1;
  pid_t child_ = -1;
};

}  // namespace ream::bench
