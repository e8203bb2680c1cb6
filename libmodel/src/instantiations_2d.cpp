#define FPZ_DIM 2
#include "instantiations.inl"
