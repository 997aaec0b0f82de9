// Lets a program that lies beside no module find those of its build, unless it is told of others.
#include <stdlib.h>

namespace {

[[maybe_unused]] const int kTold = ::setenv("SHOAL_MODULE_PATH", SHOAL_TEST_MODULE_FOLDER, 0);

}  // namespace
