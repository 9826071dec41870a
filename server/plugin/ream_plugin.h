/* Models and devices of your own for ream, as a shared object: see docs/plugins.md. C99.
 *
 * A plug-in is a shared object that exports one constant, `ream_plugin`. It has a feed model, a score, a
 * device, or several of them. It runs with all the rights of the program that loads it.
 * Lengths are millimetres, forces newtons, times seconds, angles radians. */
#ifndef REAM_PLUGIN_H
#define REAM_PLUGIN_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* NOLINTBEGIN(readability-identifier-naming,modernize-*): names and forms of C. */

/* Raised when a structure below changes in another way than by more members at its end. Of those that end
 * with the first version `struct_size` tells how much a plug-in knows: set it to sizeof of the structure. */
#define REAM_PLUGIN_ABI 1u

/* ---- feed model: how fast a turning reamer sinks into bone, in the 1 kHz loop ---- */

/* What does not change in a session. */
typedef struct ream_feed_settings {
  uint32_t struct_size;
  double spindle_rad_s;        /* full speed, above 0 */
  double specimen_factor;      /* feed of this specimen over the usual one, above 0 */
  double edge_reference_mm;    /* `cutting` of script or case: see docs/scripting.md */
  double edge_threshold_share; /* 0 to 1 */
  double tangential_ratio;     /* above 0 */
} ream_feed_settings;

/* Bone under the cutting surface in one tick; classes in the order cancellous, cortical, cartilage. */
typedef struct ream_engaged_bone {
  double share[3];        /* of the engaged cutting edge; they add up to 1 */
  double density_g_cc[3]; /* mean of the class, 0 to 2.55 */
  double area_mm2;        /* of the cutting surface that is engaged */
  double edge_mm;         /* cutting edge that resists motion along the axis */
  double resistance_s_mm; /* mean of 1 / (feed rate by the thesis' law at 52 N) over the engaged edge */
  double thrust_n;        /* simulated, of the tick before, for laws that are not linear in it */
} ream_engaged_bone;

typedef struct ream_cutting_load {
  double resistance_n_s_mm; /* thrust divided by feed rate: at least 0.001 */
  double torque_arm_mm;     /* torque that turns the spindle, divided by thrust: 0 or more */
  double tangential_ratio;  /* load along the lips' path over that along the normal: above 0 it gives torque and
                               sideways force by place, in place of the arm; 0: it is not known */
} ream_cutting_load;

typedef struct ream_feed_model {
  uint32_t struct_size;
  /* Before a session: what load() gets as `model`, or NULL for a model that keeps nothing. Both may be NULL. */
  void* (*create)(const ream_feed_settings* settings);
  void (*destroy)(void* model);
  /* In each tick in which the reamer touches bone, on the haptic thread. `load` is all zero. It must depend on
   * nothing but `model` and `bone`, to the bit, and keep nothing: sessions are computed again from recordings.
   * No memory is allocated or freed, no lock is taken, no file, socket or clock is used, nothing is thrown. */
  void (*load)(const void* model, const ream_engaged_bone* bone, ream_cutting_load* load);
} ream_feed_model;

/* ---- score: what a session is worth, after it has ended ---- */

typedef struct ream_metric {
  const char* name; /* as in metrics.json: "removed_volume_mm3" */
  double value;     /* not a number: it could not be measured */
} ream_metric;

#define REAM_SCORE_LINES 16
#define REAM_SCORE_LINE_BYTES 160

typedef struct ream_score {
  double points;       /* 0 to 100 */
  int32_t outcome;     /* 1: passed, 0: failed, -1: not decided */
  uint32_t line_count; /* how many of: */
  char lines[REAM_SCORE_LINES][REAM_SCORE_LINE_BYTES]; /* for people, UTF-8, each ended by a zero byte */
} ream_score;

typedef struct ream_score_model {
  uint32_t struct_size;
  /* The same metrics give the same score. `score` is all zero. May allocate; any thread, one at a time. */
  void (*score)(const ream_metric* metrics, size_t count, ream_score* score);
} ream_score_model;

/* ---- device: a thing in the hand that gives a pose and takes a force ---- */

/* In the device's own frame; `ream devices --setup` tells how the device stands before a person. */
typedef struct ream_handle_state {
  double rotation[9]; /* device from handle, row by row; the identity where the device senses none */
  double place_mm[3];
  uint8_t spindle_on, paused, clutch; /* buttons: not 0 while pressed */
  uint8_t deadman;                    /* not 0: somebody holds the handle. Devices that cannot tell say 1 */
} ream_handle_state;

typedef struct ream_handle_force {
  double force_n[3], torque_n_mm[3]; /* on the hand, never more than the device's limits */
} ream_handle_force;

enum { REAM_DEVICE_OK = 0, REAM_DEVICE_GONE = 1, REAM_DEVICE_BROKEN = 2 };

typedef struct ream_device {
  uint32_t struct_size;
  const char* name;  /* small letters, digits and -: for `--device` */
  const char* about; /* one line for people */
  /* What it renders, hand side; torque and damping may be 0: none, not known. */
  double force_max_n, torque_max_n_mm, stiffness_max_n_mm, damping_max_n_s_mm;
  double workspace_radius_mm; /* of the ball that its handle reaches */
  double handle_mass_kg;      /* that a hand moves with the handle */
  uint32_t degrees_of_freedom; /* sensed: 3 to 7 */
  /* All come from one thread that is not the haptic one; they may wait, but a read and a write take a
   * millisecond together at most. open() makes the device ready without force, or gives NULL and one line in
   * `why`. close() leaves it without force. */
  void* (*open)(char* why, size_t why_bytes);
  int (*read)(void* device, ream_handle_state* state);        /* GONE: it is opened again; BROKEN: never */
  int (*write)(void* device, const ream_handle_force* force); /* after each read; zero once more before close() */
  void (*close)(void* device);
} ream_device;

/* ---- the plug-in ---- */

typedef struct ream_plugin_description {
  uint32_t abi;         /* REAM_PLUGIN_ABI */
  uint32_t struct_size; /* sizeof(ream_plugin_description) */
  const char* name;     /* small letters, digits and -, at most 40 */
  const char* version;  /* without spaces, at most 20 */
  const ream_feed_model* feed; /* NULL: it has none */
  const ream_score_model* score;
  const ream_device* device;
} ream_plugin_description;

#if defined(__GNUC__)
#define REAM_PLUGIN_EXPORT __attribute__((visibility("default")))
#else
#define REAM_PLUGIN_EXPORT
#endif

/* What the shared object defines: const ream_plugin_description ream_plugin = {REAM_PLUGIN_ABI, ...}; */
extern REAM_PLUGIN_EXPORT const ream_plugin_description ream_plugin;

/* NOLINTEND(readability-identifier-naming,modernize-*) */

#ifdef __cplusplus
}
#endif
#endif
