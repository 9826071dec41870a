#include "record/trace_csv.hpp"

#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>

#include "core/error.hpp"
#include "core/file.hpp"
#include "record/trace_columns.hpp"

namespace ream::record {
namespace {

/// A CSV row under construction: numbers in their shortest exact form.
class Row {
 public:
  Row& add(double value) {
    separate();
    end_ = std::to_chars(end_, buffer_ + sizeof buffer_, value).ptr;
    return *this;
  }
  Row& add(int64_t value) {
    separate();
    end_ = std::to_chars(end_, buffer_ + sizeof buffer_, value).ptr;
    return *this;
  }
  Row& add(const Vec3& v) { return add(v.x()).add(v.y()).add(v.z()); }
  Row& add(const Pose& pose) {
    add(pose.translation_mm);
    for (const double q : quaternion_from_rotation(pose.rotation)) add(q);
    return *this;
  }
  void write(std::FILE* file) {
    *end_++ = '\n';
    std::fwrite(buffer_, 1, static_cast<size_t>(end_ - buffer_), file);
  }

 private:
  void separate() {
    if (end_ != buffer_) *end_++ = ',';
  }
  char buffer_[2048];
  char* end_ = buffer_;
};

[[noreturn]] void fail_to_write_trace(const std::filesystem::path& path) {
  throw Error(ErrorKind::io, "cannot write " + path.string() + ": " + std::strerror(errno));
}

}  // namespace

const std::string& TraceCsv::header_line() {
  static const std::string line = [] {
    std::string names;
    for (const TraceColumn& column : trace_columns())
      names.append(names.empty() ? "" : ",").append(column.name);
    return names;
  }();
  return line;
}

TraceCsv::TraceCsv(const std::filesystem::path& path, double voxel_volume_mm3, const Pose& plan_from_world)
    : path_(path), temporary_(path.string() + ".tmp"), values_(voxel_volume_mm3, plan_from_world) {
  file_ = std::fopen(temporary_.c_str(), "wb");
  if (file_ == nullptr) fail_to_write_trace(path_);
  std::fprintf(file_, "%s\n", header_line().c_str());
}

TraceCsv::~TraceCsv() {
  if (file_ == nullptr) return;
  std::fclose(file_);
  ::unlink(temporary_.c_str());
}

void TraceCsv::add(const TickReport& report) {
  Row row;
  values_.add(report, row);
  row.write(file_);
}

void TraceCsv::finish() {
  if (std::ferror(file_) || std::fflush(file_) != 0 || ::fsync(fileno(file_)) != 0)
    fail_to_write_trace(path_);
  std::fclose(file_);
  file_ = nullptr;
  if (std::rename(temporary_.c_str(), path_.c_str()) == 0)
    return sync_folder(std::filesystem::path(path_).parent_path());
  const int why = errno;
  ::unlink(temporary_.c_str());
  errno = why;
  fail_to_write_trace(path_);
}

}  // namespace ream::record
