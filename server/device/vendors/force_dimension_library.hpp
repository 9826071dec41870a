#pragma once
#include <string>

namespace ream::device {

/// The functions of Force Dimension's libdhd that the driver needs, by their names there without `dhd`, with
/// the types that its documentation gives (SDK 3.17). Lengths are m, forces N, torques N m; below 0 is an
/// error, and 1 (the time guard) and 2 (motors saturated) are none.
struct ForceDimensionLibrary {
  /// Opens the library. `path` from a set-up; empty: REAM_DHD_LIBRARY, or where the loader finds it. Error
  /// unavailable.
  explicit ForceDimensionLibrary(const std::string& path);

  int (*get_device_count)();
  int (*open_id)(char number);  ///< from 0, of those found; the device's id for all other calls
  int (*close)(char id);
  const char* (*get_system_name)(char id);
  const char* (*error_get_last_str)();
  int (*enable_expert_mode)();
  int (*disable_expert_mode)();
  int (*set_watchdog)(unsigned char periods, char id);  ///< of 125 us
  int (*enable_force)(unsigned char on, char id);
  bool (*has_wrist)(char id);
  int (*get_status)(int status[], char id);
  int (*get_pose)(double* x, double* y, double* z, double rotation[3][3], char id);
  unsigned (*get_button_mask)(char id);
  int (*set_force_and_torque)(double fx, double fy, double fz, double tx, double ty, double tz,
                              double gripper, char id);
  int (*set_max_force)(double newtons, char id);  ///< null in releases that do not have it

  /// What went wrong last, in the maker's words.
  std::string last_error() const;
};

}  // namespace ream::device
