#include "reader/vibration_file.hpp"

#include <sndfile.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>
#include <string_view>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/text.hpp"

namespace ream::reader {
namespace {

namespace fs = std::filesystem;
using force::max_recording_hz, force::max_recording_samples, force::min_recording_hz;

[[noreturn]] void refuse(const std::string& where, const std::string& complaint) {
  throw Error(ErrorKind::invalid_input, where + " " + complaint);
}

[[noreturn]] void refuse_line(const std::string& where, size_t line, const std::string& complaint) {
  refuse(where + ":" + std::to_string(line), complaint);
}

std::string_view without_blanks(std::string_view text) {
  constexpr std::string_view blank = " \t\r";
  const size_t first = text.find_first_not_of(blank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blank) - first + 1);
}

double number(std::string_view text, const std::string& where, size_t line) {
  double value = 0.0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    refuse_line(where, line, "must hold a finite number, not '" + std::string(text.substr(0, 40)) + "'");
  return value;
}

/// What a CSV file says, and whether it has times.
struct Columns {
  bool timed = false;
  std::vector<double> times_s, samples;
  std::vector<size_t> lines;  ///< of each time, for complaints
};

void read_row(std::string_view row, Columns& columns, const std::string& where, size_t line) {
  const size_t comma = row.find(',');
  if ((comma != std::string_view::npos) != columns.timed)
    refuse_line(where, line,
                columns.timed ? "must hold a time and a number of g, 'time_s,g'"
                              : "must hold one number of g; two columns need the heading 'time_s,g'");
  if (columns.timed) {
    columns.times_s.push_back(number(without_blanks(row.substr(0, comma)), where, line));
    columns.lines.push_back(line);
  }
  columns.samples.push_back(number(columns.timed ? without_blanks(row.substr(comma + 1)) : row, where, line));
  if (columns.samples.size() > max_recording_samples)
    refuse_line(where, line, "is beyond 20 million samples; take a shorter part of the recording");
}

Columns read_columns(std::string_view text, const std::string& where) {
  Columns columns;
  for (size_t line = 1; !text.empty(); ++line) {
    const size_t end = std::min(text.find('\n'), text.size());
    const std::string_view row = without_blanks(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (row.empty() || (line == 1 && row == "g")) continue;
    if (line == 1 && row == "time_s,g")
      columns.timed = true;
    else
      read_row(row, columns, where, line);
  }
  if (columns.samples.size() < 2) refuse(where, "holds fewer than two samples; is it the right file?");
  return columns;
}

double rate_of(const Columns& columns, const std::string& where) {
  const std::vector<double>& times_s = columns.times_s;
  std::vector<double> steps_s(times_s.size() - 1);
  for (size_t i = 0; i < steps_s.size(); ++i) steps_s[i] = times_s[i + 1] - times_s[i];
  std::vector<double> sorted = steps_s;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  const double default_s = *middle;
  if (!(default_s > 0.0))
    refuse(where, "has times that do not ascend; give seconds in the order of recording");
  for (size_t i = 0; i < steps_s.size(); ++i)
    if (std::abs(steps_s[i] - default_s) > 0.5 * default_s)
      refuse_line(where, columns.lines[i + 1],
                  "breaks the even spacing of times; resample the recording or give one column and rate_hz");
  return static_cast<double>(steps_s.size()) / (times_s.back() - times_s.front());
}

void check_rate(double rate_hz, const std::string& where) {
  if (rate_hz < min_recording_hz || rate_hz > max_recording_hz)
    refuse(where, "is sampled at " + std::to_string(std::lround(rate_hz)) +
                      " Hz; take a recording of 1000 to 1000000 Hz");
}

VibrationRecording read_wav(const fs::path& path) {
  const std::string where = path.string();
  SF_INFO info{};
  const std::unique_ptr<SNDFILE, int (*)(SNDFILE*)> file(sf_open(path.c_str(), SFM_READ, &info), sf_close);
  if (!file) refuse(where, std::string("cannot be read as sound: ") + sf_strerror(nullptr));
  if (info.channels != 1)
    refuse(where, "has " + std::to_string(info.channels) + " channels; save the one of the accelerometer");
  if (info.frames < 2) refuse(where, "holds fewer than two samples; is it the right file?");
  if (static_cast<size_t>(info.frames) > max_recording_samples)
    refuse(where, "is beyond 20 million samples; take a shorter part of the recording");
  VibrationRecording recording;
  recording.rate_hz = info.samplerate;
  recording.samples.resize(static_cast<size_t>(info.frames));
  if (sf_readf_double(file.get(), recording.samples.data(), info.frames) != info.frames)
    refuse(where, "ends before its header says; save it again");
  const auto odd = std::find_if_not(recording.samples.begin(), recording.samples.end(),
                                    [](double sample) { return std::isfinite(sample); });
  if (odd != recording.samples.end())
    refuse(where, "holds something that is no finite number at sample " +
                      std::to_string(odd - recording.samples.begin()) + "; repair it");
  return recording;
}

}  // namespace

VibrationRecording parse_vibration_csv(const std::string& text, double rate_hz, const std::string& where) {
  Columns columns = read_columns(text, where);
  if (!columns.timed && rate_hz <= 0.0)
    refuse(where, "has no times; give its sampling rate as rate_hz, or a column of times 'time_s,g'");
  return {std::move(columns.samples), columns.timed ? rate_of(columns, where) : rate_hz};
}

VibrationRecording read_vibration_file(const fs::path& path, double rate_hz) {
  const std::string extension = lower(path.extension().string());
  if (extension != ".wav" && extension != ".csv")
    refuse(path.string(), "is no vibration recording; give a .wav or .csv file");
  VibrationRecording recording = extension == ".wav"
                                     ? read_wav(path)
                                     : parse_vibration_csv(read_text_file(path), rate_hz, path.string());
  check_rate(recording.rate_hz, path.string());
  return recording;
}

}  // namespace ream::reader
