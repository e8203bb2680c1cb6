/* The C interface from C99. What a check prints is the line that failed. */
#include <fpz.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int failures = 0;

#define CHECK(holds)                                     \
  do {                                                   \
    if (!(holds)) {                                      \
      printf("%s:%d: %s\n", __FILE__, __LINE__, #holds); \
      ++failures;                                        \
    }                                                    \
  } while (0)

/* Table 1 of the paper, published zone; H in metres. */
static fpz_material* johnstone(fpz_setting setting, double length) {
  double list[13] = {0.4e9, 0.25, 1540, 0.6e6, 1e6, 33, 4, 18e-6, 1e13, 1e11, 0, 0, 1};
  fpz_material* m = NULL;
  list[10] = length;
  CHECK(fpz_material_new(setting, list, 13, &m) == FPZ_OK);
  return m;
}

static int property_of(const char* name) {
  for (int k = 0; k < fpz_property_count(); ++k) {
    if (strcmp(fpz_property_name(k), name) == 0) return k;
  }
  return -1;
}

static void test_lists(void) {
  CHECK(fpz_interface_version() == FPZ_INTERFACE_VERSION);
  CHECK(strcmp(fpz_version(), "0.1.0") == 0);
  CHECK(property_of("young_modulus") == 0);
  CHECK(property_of("rve_length") == 10);
  CHECK(property_of("integrator_tolerance") == 14);
  CHECK(strcmp(fpz_property_unit(9), "Pa/m") == 0);
  CHECK(strcmp(fpz_property_values(property_of("softening")), "0 (exponential) or 1 (bilinear)") == 0);
  CHECK(isnan(fpz_property_default(0)));
  CHECK(fpz_property_default(14) == 1e-6);
  CHECK(fpz_property_name(-1) == NULL);
  CHECK(fpz_property_name(fpz_property_count()) == NULL);
  CHECK(fpz_property_values(1000) == NULL && fpz_property_unit(1000) == NULL && isnan(fpz_property_default(1000)));
  CHECK(fpz_state_size(FPZ_PLANE_STRESS) == 23 && fpz_state_size(FPZ_THREE_D) == 38);
  CHECK(fpz_tensor_size(FPZ_PLANE_STRAIN) == 3 && fpz_tensor_size(FPZ_THREE_D) == 6);
  CHECK(strcmp(fpz_state_name(FPZ_PLANE_STRAIN, 6), "cracked") == 0);
  CHECK(strcmp(fpz_state_name(FPZ_THREE_D, 37), "damage") == 0);
  CHECK(fpz_state_name(FPZ_THREE_D, 38) == NULL && fpz_state_name(FPZ_PLANE_STRAIN, -1) == NULL);
  CHECK(strcmp(fpz_status_word(FPZ_SNAP_BACK), "snap_back") == 0);
  CHECK(strcmp(fpz_status_word(17), "unknown") == 0 && strcmp(fpz_status_word(256), "unknown") == 0);
}

/* Closed form: elastic in plane strain; after onset the tangent is that of differences. */
static void test_update(void) {
  fpz_material* m = johnstone(FPZ_PLANE_STRAIN, 1e-3);
  const double small[3] = {1e-4, -2e-4, 3e-5}, lambda = 0.16e9, mu = 0.16e9;
  const double opening[3] = {3e-3, -1e-3, 1.5e-3};
  double state[23] = {0}, end[23], tangent[9], energies[2];
  CHECK(fpz_update(m, state, small, state, tangent, energies) == FPZ_OK);
  CHECK(fabs(state[3] - (lambda * -1e-4 + 2 * mu * 1e-4)) < 1e-6);
  CHECK(fabs(state[5] - 2 * mu * 3e-5) < 1e-6);
  CHECK(fabs(tangent[8] - 2 * mu) < 1e-3);
  CHECK(fabs(energies[0] - 0.5 * (state[3] * 1e-4 - state[4] * 2e-4 + 2 * state[5] * 3e-5)) < 1e-12);
  CHECK(energies[1] == 0.0);
  CHECK(fpz_update(m, state, opening, end, tangent, energies) == FPZ_OK);
  CHECK(end[6] == 1.0 && end[22] > 0.1 && energies[1] > 0.0);
  for (int j = 0; j < 3; ++j) {
    double less[23], more[23], step[3];
    const double h = 1e-9;
    memcpy(step, opening, sizeof step);
    step[j] = opening[j] - h;
    CHECK(fpz_update(m, state, step, less, NULL, NULL) == FPZ_OK);
    step[j] = opening[j] + h;
    CHECK(fpz_update(m, state, step, more, NULL, NULL) == FPZ_OK);
    for (int i = 0; i < 3; ++i) CHECK(fabs((more[3 + i] - less[3 + i]) / (2 * h) - tangent[3 * i + j]) < 1e-5 * 0.4e9);
  }
  fpz_material_free(m);
}

static void test_refusals(void) {
  double list[22] = {0.4e9, 0.25, 1540, 0.6e6, 3e5, 33, 4, 18e-6, 1e13, 1e11, 4e-3};
  double state[23] = {0}, before[23], increment[3] = {1e-2, 0, 0};
  fpz_material* m = (fpz_material*)list;
  CHECK(fpz_material_new(FPZ_PLANE_STRAIN, list, 11, &m) == FPZ_INVALID_INPUT);
  CHECK(m == NULL);
  CHECK(strstr(fpz_message(), "property 5, cohesion = 3e+05: must be > ") == fpz_message());
  CHECK(fpz_material_new(FPZ_PLANE_STRAIN, list, 22, &m) == FPZ_INVALID_INPUT);
  CHECK(fpz_material_new(9, list, 11, &m) == FPZ_INVALID_INPUT);
  CHECK(fpz_material_new(FPZ_PLANE_STRAIN, NULL, 11, &m) == FPZ_INVALID_INPUT);
  CHECK(fpz_material_new(FPZ_PLANE_STRAIN, list, 11, NULL) == FPZ_INVALID_INPUT);
  CHECK(fpz_material_new(FPZ_PLANE_STRAIN, list, -1, &m) == FPZ_INVALID_INPUT);
  CHECK(fpz_update(NULL, state, increment, state, NULL, NULL) == FPZ_INVALID_INPUT);
  CHECK(fpz_update_batch(NULL, NULL, NULL) == FPZ_INVALID_INPUT);
  CHECK(fpz_material_set_length(NULL, 1.0) == FPZ_INVALID_INPUT);
  CHECK(strcmp(fpz_material_warnings(NULL), "") == 0 && isnan(fpz_material_snap_back_length(NULL)));
  fpz_material_free(NULL);

  m = johnstone(FPZ_PLANE_STRAIN, 4e-3);
  CHECK(fabs(fpz_material_snap_back_length(m) - 0.0144) < 1e-9);
  CHECK(fpz_material_set_length(m, -1.0) == FPZ_INVALID_INPUT);
  CHECK(fpz_material_set_length(m, 1.0) == FPZ_OK);
  CHECK(strstr(fpz_material_warnings(m), "property 11, rve_length = 1: should be < ") != NULL);
  memcpy(before, state, sizeof state);
  CHECK(fpz_update(m, state, increment, state, NULL, NULL) == FPZ_SNAP_BACK);
  CHECK(memcmp(before, state, sizeof state) == 0);
  CHECK(strstr(fpz_message(), "snap_back: ") == fpz_message());
  increment[0] = NAN;
  CHECK(fpz_update(m, state, increment, state, NULL, NULL) == FPZ_INVALID_INPUT);
  state[6] = 0.5;
  CHECK(fpz_update(m, state, increment, state, NULL, NULL) == FPZ_INVALID_INPUT);
  fpz_material_free(m);
}

enum { points = 600 };

/* Component by component and point by point give the single updates. */
static void test_batch(void) {
  fpz_material* m = johnstone(FPZ_PLANE_STRAIN, 1e-3);
  double* rows = calloc(points * 23, sizeof(double));
  double* columns = calloc(points * 23, sizeof(double));
  double* increments = calloc(points * 3, sizeof(double));
  fpz_batch batch;
  fpz_report report;
  memset(&batch, 0, sizeof batch);
  for (int i = 0; i < points; ++i) {
    increments[3 * i] = 5e-3 * i / points;
    increments[3 * i + 2] = 2e-3 * i / points;
  }
  batch.points = points;
  batch.begin.data = batch.end.data = rows;
  batch.begin.point = batch.end.point = 23;
  batch.begin.component = batch.end.component = 1;
  batch.strain_increments.data = increments;
  batch.strain_increments.point = 3;
  batch.strain_increments.component = 1;
  CHECK(fpz_update_batch(m, &batch, &report) == FPZ_OK);
  CHECK(report.failed == 0 && report.cracked > 100 && report.cracked < points && report.cracked == report.new_cracks);
  batch.begin.data = batch.end.data = columns;
  batch.begin.point = batch.end.point = 1;
  batch.begin.component = batch.end.component = points;
  CHECK(fpz_update_batch(m, &batch, NULL) == FPZ_OK);
  for (int i = 0; i < points; ++i) {
    double state[23] = {0};
    CHECK(fpz_update(m, state, increments + 3 * i, state, NULL, NULL) == FPZ_OK);
    for (int k = 0; k < 23; ++k) CHECK(rows[23 * i + k] == state[k] && columns[k * points + i] == state[k]);
  }
  {
    double* lengths = malloc(points * sizeof(double));
    for (int i = 0; i < points; ++i) lengths[i] = i == 550 || i == 590 ? 1.0 : 1e-3;
    memset(columns, 0, points * 23 * sizeof(double));
    batch.lengths = lengths;
    CHECK(fpz_update_batch(m, &batch, &report) == FPZ_SNAP_BACK);
    CHECK(report.failed == 2 && report.first_failed == 550);
    CHECK(strstr(fpz_message(), "point 550: snap_back: ") == fpz_message());
    CHECK(columns[550] == 0.0 && columns[551] > 0.0);
    free(lengths);
  }
  batch.end.data = NULL;
  CHECK(fpz_update_batch(m, &batch, &report) == FPZ_INVALID_INPUT);
  free(rows);
  free(columns);
  free(increments);
  fpz_material_free(m);
}

/* c_test [FOLDER]: with a folder, one failing update is captured there. */
int main(int argc, char** argv) {
  if (argc > 1) {
    fpz_material* m = johnstone(FPZ_THREE_D, 1.0);
    const double increment[6] = {1e-2, 0, 0, 0, 0, 0};
    double state[38] = {0};
    fpz_capture_failures(argv[1]);
    CHECK(fpz_update(m, state, increment, state, NULL, NULL) == FPZ_SNAP_BACK);
    CHECK(strstr(fpz_message(), "captured: fpz-driver replay ") != NULL);
    fpz_capture_failures(NULL);
    CHECK(fpz_update(m, state, increment, state, NULL, NULL) == FPZ_SNAP_BACK);
    CHECK(strstr(fpz_message(), "captured") == NULL);
    fpz_material_free(m);
  } else {
    test_lists();
    test_update();
    test_refusals();
    test_batch();
  }
  if (failures == 0) printf("all checks hold\n");
  return failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
