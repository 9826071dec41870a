#pragma once
#include <string>

namespace ream::device {

/// The functions of OpenHaptics' HDAPI (libHD) that the driver needs, by their names there without `hd`, with
/// the types that its documentation gives. Lengths are mm, forces N, torques mN m (the same as N mm).
struct OpenHapticsLibrary {
  struct ErrorInfo {
    unsigned code;
    int internal_code;
    unsigned device;
  };
  using Callback = unsigned (*)(void* user);
  static constexpr unsigned callback_done = 0, callback_continue = 1;
  static constexpr unsigned invalid_device = 0xFFFFFFFF;
  static constexpr unsigned short default_priority = 0x7FFF;

  // Parameters, abilities and errors, by number.
  static constexpr unsigned buttons = 0x2000, transform = 0x2052, nominal_max_force = 0x2603,
                            nominal_max_continuous_force = 0x2604, force = 0x2700, torque = 0x2701,
                            force_output = 0x4000, max_force_clamping = 0x4001;
  static constexpr unsigned success = 0, warm_motors = 0x0200, first_device_error = 0x0300,
                            last_device_error = 0x03FF, invalid_license = 0x0600;

  /// Opens the library. `path` from a set-up; empty: REAM_HD_LIBRARY, or where the loader finds it. Error
  /// unavailable.
  explicit OpenHapticsLibrary(const std::string& path);

  unsigned (*init_device)(const char* name);  ///< null: the default one
  void (*disable_device)(unsigned device);
  void (*make_current_device)(unsigned device);
  void (*enable)(unsigned ability);
  void (*disable)(unsigned ability);
  void (*start_scheduler)();
  void (*stop_scheduler)();
  unsigned long (*schedule_asynchronous)(Callback callback, void* user, unsigned short priority);
  void (*unschedule)(unsigned long handle);
  void (*begin_frame)(unsigned device);
  void (*end_frame)(unsigned device);
  void (*get_doubles)(unsigned parameter, double* values);
  void (*get_integers)(unsigned parameter, int* values);
  void (*set_doubles)(unsigned parameter, const double* values);
  ErrorInfo (*get_error)();  ///< takes the newest from the library's list; success: there is none
  const char* (*get_error_string)(unsigned code);
};

}  // namespace ream::device
