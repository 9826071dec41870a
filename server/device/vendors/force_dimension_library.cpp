#include "device/vendors/force_dimension_library.hpp"

#include "device/vendors/vendor_library.hpp"

namespace ream::device {

ForceDimensionLibrary::ForceDimensionLibrary(const std::string& path) {
  const VendorLibrary library(
      {"Force Dimension's SDK", path, "REAM_DHD_LIBRARY", {"libdhd.so.3", "libdhd.so", "libdrd.so.3"}});
  library.find(get_device_count, "dhdGetDeviceCount");
  library.find(open_id, "dhdOpenID");
  library.find(close, "dhdClose");
  library.find(get_system_name, "dhdGetSystemName");
  library.find(error_get_last_str, "dhdErrorGetLastStr");
  library.find(enable_expert_mode, "dhdEnableExpertMode");
  library.find(disable_expert_mode, "dhdDisableExpertMode");
  library.find(set_watchdog, "dhdSetWatchdog");
  library.find(enable_force, "dhdEnableForce");
  library.find(has_wrist, "dhdHasWrist");
  library.find(get_status, "dhdGetStatus");
  library.find(get_pose, "dhdGetPositionAndOrientationFrame");
  library.find(get_button_mask, "dhdGetButtonMask");
  library.find(set_force_and_torque, "dhdSetForceAndTorqueAndGripperForce");
  library.find_optional(set_max_force, "dhdSetMaxForce");
}

std::string ForceDimensionLibrary::last_error() const {
  const char* message = error_get_last_str();
  return message != nullptr ? message : "no reason given";
}

}  // namespace ream::device
