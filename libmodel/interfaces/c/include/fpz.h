/* The model for C and for all that can call C. Fortran: module fpz in fpz.f90.
 *
 * A material is an opaque handle made from one list of numbers (fpz_property_name() says which). A point's state is an
 * array of doubles (fpz_state_name()); zeros are a fresh point. Any consistent units do; names of units are SI. Tension
 * is positive. Shear strains are tensor components, not engineering shears. Components: xx, yy, xy in the plane
 * settings; xx, yy, zz, xy, xz, yz in three dimensions.
 *
 * Functions that can fail return a status. fpz_message() then says what was wrong and what helps. Nothing throws, exits
 * or prints. All functions may be called from several threads at once; a handle that is being changed or freed may not
 * be in use elsewhere. */
#ifndef FPZ_H
#define FPZ_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Of this header; fpz_interface_version() is that of the library. It grows when a call or a layout changes: the list of
 * properties, the layout of the state, or a function below. */
#define FPZ_INTERFACE_VERSION 1

/* Enumerations are plain integers where they are passed, for callers in other languages. */
enum { FPZ_PLANE_STRAIN = 0, FPZ_PLANE_STRESS = 1, FPZ_THREE_D = 2 };
typedef int fpz_setting;

/* The outcome of a call. After anything but FPZ_OK the state is what it was. */
enum {
  FPZ_OK = 0,
  FPZ_NON_CONVERGENCE = 1, /* the integrator failed: a smaller increment, or the integrator "accurate" */
  FPZ_SNAP_BACK = 2,       /* no unique solution under strain control: a smaller rve_length */
  FPZ_NO_PLASTIC_FLOW = 3, /* dilation angle 0 and pure opening */
  FPZ_INVALID_INPUT = 4    /* a number that is not finite, an array that is not a state, a material that cannot be */
};
typedef int fpz_status;

typedef struct fpz_material fpz_material;

int fpz_interface_version(void);
const char* fpz_version(void);                 /* of the package, "0.1.0" */
const char* fpz_status_word(fpz_status);       /* "snap_back" */
const char* fpz_message(void);                 /* of the last failure in this thread; valid until its next failure */
void fpz_capture_failures(const char* folder); /* failing updates are written there for `fpz-driver replay`; NULL or "":
                                                  into the folder that the environment variable FPZ_CAPTURE names, if
                                                  any. At most 100 for one folder. */

/* The list of properties: k counts from 0; NULL or NaN for a k that is none. */
int fpz_property_count(void);
const char* fpz_property_name(int k); /* "young_modulus", ..., "rve_length", "softening", ..., "integrator_name", ... */
const char* fpz_property_unit(int k); /* "Pa" */
const char* fpz_property_values(int k); /* "> 0"; "0 (accurate), 1 (implicit) or 2 (paper)"; "" */
double fpz_property_default(int k);     /* what 0, or a number missing at the end, means; NaN: it must be given */

/* The state of a point: k counts from 0; NULL for a k that is none. */
int fpz_tensor_size(fpz_setting); /* 3 or 6 */
int fpz_state_size(fpz_setting);  /* 23 or 38 */
const char* fpz_state_name(fpz_setting, int k);

/* Makes and checks a material. Numbers missing at the end of the list have their defaults. On failure *material is
 * NULL, and the message names every property that is at fault with its value and its constraint. */
fpz_status fpz_material_new(fpz_setting, const double* properties, int count, fpz_material** material);
void fpz_material_free(fpz_material*);                     /* NULL is allowed */
const char* fpz_material_warnings(const fpz_material*);    /* what is doubtful, one line each; "" as a rule */
double fpz_material_snap_back_length(const fpz_material*); /* rve_length must be smaller: mode I snaps back */
fpz_status fpz_material_set_length(fpz_material*, double rve_length);

/* One point: from the state `begin` over a strain increment to the state `end`, which may be the same array. `tangent`,
 * if not NULL, gets d(stress_i)/d(tensor strain_j), row by row; `energies`, if not NULL, gets the stored and the
 * dissipated energy per volume. */
fpz_status fpz_update(const fpz_material*, const double* begin, const double* strain_increment, double* end,
                      double* tangent, double* energies);

/* Numbers of many points: component k of point i is data[i * point + k * component]. Point by point in rows of n
 * numbers: point = n, component = 1. Component by component: point = 1, component = number of points. */
typedef struct {
  double* data; /* NULL: not wanted */
  ptrdiff_t point;
  ptrdiff_t component;
} fpz_array;

typedef struct {
  size_t points;
  fpz_array begin;             /* states; read */
  fpz_array strain_increments; /* read */
  fpz_array end;               /* states; may be `begin` */
  fpz_array tangents;          /* or NULL */
  fpz_array energies;          /* or NULL */
  const double* lengths;       /* rve_length of every point, or NULL: that of the material */
  int* statuses;               /* an fpz_status for every point, or NULL */
  int threads;                 /* 0: all that OpenMP offers. The result does not depend on it. */
} fpz_batch;

typedef struct {
  size_t failed;
  size_t first_failed; /* lowest index; meaningless when none has failed */
  size_t cracked;      /* points that are cracked at the end */
  size_t new_cracks;   /* points that cracked in this call */
  long long iterations;
} fpz_report;

/* Points that fail keep their begin state, without tangent and energies; the others are updated all the same. Returns
 * the status of the first that failed, of which the message speaks. `report` may be NULL. */
fpz_status fpz_update_batch(const fpz_material*, const fpz_batch*, fpz_report* report);

#ifdef __cplusplus
}
#endif

#endif
