// Which instruction sets this processor has, for code that is compiled for several.
#pragma once

#if defined(__x86_64__) && __has_include(<sys/platform/x86.h>)
#ifdef __clang__
#define _Bool bool  // glibc 2.36 says _Bool there, which Clang does not know in C++
#include <sys/platform/x86.h>
#undef _Bool
#else
#include <sys/platform/x86.h>
#endif
#endif

// SHOAL_PROCESSOR_HAS("avx2", AVX2): whether the processor has an instruction set, and the
// operating system keeps its registers; the names are GCC's and glibc's. x86-64 alone.
//
// glibc has asked the processor when it loaded the program, and its answer is taken where it has a
// function to tell it (2.34 on). GCC's __builtin_cpu_supports asks again before main(), wherever in
// the program it is used; a virtual machine traps each question, 80 us of every start in sum.
#ifdef CPU_FEATURE_ACTIVE
#define SHOAL_PROCESSOR_HAS(GCC_NAME, GLIBC_NAME) CPU_FEATURE_ACTIVE(GLIBC_NAME)
#else
#define SHOAL_PROCESSOR_HAS(GCC_NAME, GLIBC_NAME) __builtin_cpu_supports(GCC_NAME)
#endif
