// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CCDM_TESTS_FUZZ_TARGETS_H
#define CCDM_TESTS_FUZZ_TARGETS_H

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

/// What is fuzzed. A broken promise ends the process.
namespace fuzz {

/// Bytes as a small mesh and parameters, remeshed.
void RunRemesher(const std::uint8_t *data, std::size_t size);

/// Bytes as a mesh file, the first one as its format: read, written and read again.
void RunReaders(const std::uint8_t *data, std::size_t size);

/// The same, and remeshed before it is written.
void RunFile(const std::uint8_t *data, std::size_t size);

inline void Expect(bool holds, const std::string &what)
{
    if (holds)
        return;
    std::fprintf(stderr, "broken promise: %s\n", what.c_str());
    std::abort();
}

} // namespace fuzz

#endif
