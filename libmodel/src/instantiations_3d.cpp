#define FPZ_DIM 3
#include "instantiations.inl"
