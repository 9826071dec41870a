#include "device/vendors/open_haptics_library.hpp"

#include "device/vendors/vendor_library.hpp"

namespace ream::device {

OpenHapticsLibrary::OpenHapticsLibrary(const std::string& path) {
  const VendorLibrary library(
      {"3D Systems' OpenHaptics", path, "REAM_HD_LIBRARY", {"libHD.so.3.4", "libHD.so.3", "libHD.so"}});
  library.find(init_device, "hdInitDevice");
  library.find(disable_device, "hdDisableDevice");
  library.find(make_current_device, "hdMakeCurrentDevice");
  library.find(enable, "hdEnable");
  library.find(disable, "hdDisable");
  library.find(start_scheduler, "hdStartScheduler");
  library.find(stop_scheduler, "hdStopScheduler");
  library.find(schedule_asynchronous, "hdScheduleAsynchronous");
  library.find(unschedule, "hdUnschedule");
  library.find(begin_frame, "hdBeginFrame");
  library.find(end_frame, "hdEndFrame");
  library.find(get_doubles, "hdGetDoublev");
  library.find(get_integers, "hdGetIntegerv");
  library.find(set_doubles, "hdSetDoublev");
  library.find(get_error, "hdGetError");
  library.find(get_error_string, "hdGetErrorString");
}

}  // namespace ream::device
