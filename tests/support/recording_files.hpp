#pragma once
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>

namespace ream::test {

/// Bytes of a WAV file of 32-bit floats, channels interleaved, as the format's description has it.
inline std::string wav_bytes(std::span<const float> samples, uint32_t rate_hz, uint16_t channels = 1) {
  std::string bytes;
  const auto add = [&](auto value) {
    static_assert(std::is_trivially_copyable_v<decltype(value)>);
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes.append(raw, sizeof value);
  };
  const auto data_bytes = static_cast<uint32_t>(samples.size() * sizeof(float));
  constexpr uint16_t ieee_float = 3, bits = 32;
  bytes += "RIFF";
  add(static_cast<uint32_t>(36 + data_bytes));
  bytes += "WAVEfmt ";
  add(uint32_t{16});
  add(ieee_float);
  add(channels);
  add(rate_hz);
  add(static_cast<uint32_t>(rate_hz * channels * sizeof(float)));
  add(static_cast<uint16_t>(channels * sizeof(float)));
  add(bits);
  bytes += "data";
  add(data_bytes);
  for (const float sample : samples) add(sample);
  return bytes;
}

/// One column of g, digits enough to read back the same numbers.
inline std::string csv_text(std::span<const float> samples) {
  std::string text = "g\n";
  char line[64];
  for (const float sample : samples) {
    std::snprintf(line, sizeof line, "%.17g\n", static_cast<double>(sample));
    text += line;
  }
  return text;
}

/// Times from `start_s` and g.
inline std::string timed_csv_text(std::span<const float> samples, double rate_hz, double start_s = 0.0) {
  std::string text = "time_s,g\r\n";
  char line[64];
  for (size_t i = 0; i < samples.size(); ++i) {
    std::snprintf(line, sizeof line, "%.9f, %.9g\r\n", start_s + static_cast<double>(i) / rate_hz,
                  static_cast<double>(samples[i]));
    text += line;
  }
  return text;
}

}  // namespace ream::test
