// SPDX-License-Identifier: GPL-3.0-or-later
// One of the targets as libFuzzer calls it.
#include "fuzz/targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
    fuzz::CCDM_FUZZ_TARGET(data, size);
    return 0;
}
