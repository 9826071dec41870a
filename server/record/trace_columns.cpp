#include "record/trace_columns.hpp"

#include <array>

namespace ream::record {
namespace {

constexpr tables::ColumnType count = tables::ColumnType::count, flag = tables::ColumnType::flag;

constexpr std::array columns = {
    TraceColumn{"t_s", "s", "Time since the start of the session, pauses among it."},
    TraceColumn{"handle_x_mm", "mm", "Where the hand holds the handle, x in the world frame."},
    TraceColumn{"handle_y_mm", "mm", "Where the hand holds the handle, y in the world frame."},
    TraceColumn{"handle_z_mm", "mm", "Where the hand holds the handle, z in the world frame."},
    TraceColumn{"handle_qw", "",
                "Part w of the unit quaternion that turns the handle's frame into the world frame."},
    TraceColumn{"handle_qx", "",
                "Part x of the unit quaternion that turns the handle's frame into the world frame."},
    TraceColumn{"handle_qy", "",
                "Part y of the unit quaternion that turns the handle's frame into the world frame."},
    TraceColumn{"handle_qz", "",
                "Part z of the unit quaternion that turns the handle's frame into the world frame."},
    TraceColumn{"tool_x_mm", "mm", "Apex of the reamer, x in the world frame."},
    TraceColumn{"tool_y_mm", "mm", "Apex of the reamer, y in the world frame."},
    TraceColumn{"tool_z_mm", "mm", "Apex of the reamer, z in the world frame."},
    TraceColumn{"tool_qw", "",
                "Part w of the unit quaternion that turns the reamer's frame into the world frame."},
    TraceColumn{"tool_qx", "",
                "Part x of the unit quaternion that turns the reamer's frame into the world frame."},
    TraceColumn{"tool_qy", "",
                "Part y of the unit quaternion that turns the reamer's frame into the world frame."},
    TraceColumn{"tool_qz", "",
                "Part z of the unit quaternion that turns the reamer's frame into the world frame."},
    TraceColumn{"spindle_on", "", "1 while the spindle is on.", flag},
    TraceColumn{"paused", "", "1 while the session is paused.", flag},
    TraceColumn{"thrust_n", "N",
                "Simulated force of the bone along the reamer's axis; pressing into the bone is positive."},
    TraceColumn{"hand_force_x_n", "N", "Force that the device was sent, x in the world frame."},
    TraceColumn{"hand_force_y_n", "N", "Force that the device was sent, y in the world frame."},
    TraceColumn{"hand_force_z_n", "N", "Force that the device was sent, z in the world frame."},
    TraceColumn{"torque_n_mm", "N mm",
                "Simulated moment of the spring on the reamer about its apex, its magnitude."},
    TraceColumn{"spindle_torque_n_mm", "N mm", "Simulated torque that turns the spindle against the bone."},
    TraceColumn{"guide_force_n", "N", "Simulated force that the guide or the pilot hole takes."},
    TraceColumn{"vibration_g", "g", "Acceleration of the reamer by cutting, beside what contact does."},
    TraceColumn{"hand_weakened", "",
                "1 where the hand feels clearly less than the simulated force over the force scale.", flag},
    TraceColumn{"feed_rate_mm_s", "mm/s", "Speed of the reamer along its axis while it touches bone."},
    TraceColumn{"density_g_cc", "g/cm3",
                "Mean density of the bone that the cutting edges touch; 0 without contact."},
    TraceColumn{"share_cancellous", "", "Share of the touched bone that is cancellous."},
    TraceColumn{"share_cortical", "", "Share of the touched bone that is cortical."},
    TraceColumn{"share_cartilage", "", "Share of what is touched that is cartilage."},
    TraceColumn{"engaged_points", "", "Number of the reamer's points in bone.", count},
    TraceColumn{"removed_volume_mm3", "mm3", "Bone removed since the start of the session."},
    TraceColumn{"bone_x_mm", "mm", "How far the mount has let the bone move, x in the world frame."},
    TraceColumn{"bone_y_mm", "mm", "How far the mount has let the bone move, y in the world frame."},
    TraceColumn{"bone_z_mm", "mm", "How far the mount has let the bone move, z in the world frame."},
    TraceColumn{"bone_qw", "", "Part w of the unit quaternion by which the bone has turned since the start."},
    TraceColumn{"bone_qx", "", "Part x of the unit quaternion by which the bone has turned since the start."},
    TraceColumn{"bone_qy", "", "Part y of the unit quaternion by which the bone has turned since the start."},
    TraceColumn{"bone_qz", "", "Part z of the unit quaternion by which the bone has turned since the start."},
    TraceColumn{"spindle_speed_rad_s", "rad/s", "Simulated speed of the spindle; in reverse negative."},
    TraceColumn{"stalled", "", "1 while the drive cannot turn the reamer.", flag},
    TraceColumn{"irrigating", "", "1 while the bone is irrigated.", flag},
    TraceColumn{"surface_temperature_c", "°C",
                "Temperature of the bone under the reamer; 35 where nothing has warmed it."},
    TraceColumn{
        "tool_depth_mm", "mm",
        "How far the reamer's apex is past the planned entry along the planned axis, with the bone."}};

}  // namespace

std::span<const TraceColumn> trace_columns() { return columns; }

}  // namespace ream::record
