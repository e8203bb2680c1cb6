/* Pulls one point of rock apart until it is broken: strain, stress and damage as a table. */
#include <fpz.h>
#include <stdio.h>
#include <stdlib.h>

int main(void) {
  /* E, nu, density, tensile strength, cohesion, friction and dilation angle (degrees), delta0, Kn, Ks, H: SI units.
   * What is missing at the end has its default. */
  const double properties[] = {0.4e9, 0.25, 1540, 0.6e6, 1e6, 33, 4, 18e-6, 1e13, 1e11, 4e-3};
  const double increment[3] = {1e-4, 0, 0}; /* xx, yy, xy */
  double state[23] = {0};
  fpz_material* rock = NULL;

  if (fpz_interface_version() != FPZ_INTERFACE_VERSION || fpz_state_size(FPZ_PLANE_STRAIN) != 23) {
    fprintf(stderr, "libfpz and fpz.h are of different versions\n");
    return EXIT_FAILURE;
  }
  if (fpz_material_new(FPZ_PLANE_STRAIN, properties, 11, &rock) != FPZ_OK) {
    fprintf(stderr, "%s", fpz_message());
    return EXIT_FAILURE;
  }
  fprintf(stderr, "%s", fpz_material_warnings(rock));
  printf("%10s %12s %8s\n", fpz_state_name(FPZ_PLANE_STRAIN, 0), fpz_state_name(FPZ_PLANE_STRAIN, 3),
         fpz_state_name(FPZ_PLANE_STRAIN, 22));
  for (int k = 1; k <= 100; ++k) {
    if (fpz_update(rock, state, increment, state, NULL, NULL) != FPZ_OK) {
      fprintf(stderr, "%s\n", fpz_message());
      return EXIT_FAILURE;
    }
    if (k % 10 == 0) printf("%10.4f %12.5g %8.5f\n", state[0], state[3], state[22]);
  }
  fpz_material_free(rock);
  return EXIT_SUCCESS;
}
