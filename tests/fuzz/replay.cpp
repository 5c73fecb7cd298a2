// SPDX-License-Identifier: GPL-3.0-or-later
// Runs a target on files, without a fuzzer: replay remesher|readers|file FILE...
#include <cstring>
#include <fstream>
#include <iterator>
#include <vector>

#include "fuzz/targets.h"

namespace {

using Target = void (*)(const std::uint8_t *, std::size_t);

Target TargetOf(const char *name)
{
    if (std::strcmp(name, "remesher") == 0)
        return fuzz::RunRemesher;
    if (std::strcmp(name, "readers") == 0)
        return fuzz::RunReaders;
    return std::strcmp(name, "file") == 0 ? fuzz::RunFile : nullptr;
}

} // namespace

int main(int argc, char **argv)
{
    const Target target = argc > 2 ? TargetOf(argv[1]) : nullptr;
    if (target == nullptr) {
        std::fprintf(stderr, "usage: replay remesher|readers|file FILE...\n");
        return 2;
    }
    for (int k = 2; k < argc; ++k) {
        std::ifstream in(argv[k], std::ios::binary);
        if (!in) {
            std::fprintf(stderr, "%s cannot be opened\n", argv[k]);
            return 2;
        }
        const std::vector<char> bytes{std::istreambuf_iterator<char>(in), {}};
        std::printf("%s\n", argv[k]);
        std::fflush(stdout);
        target(reinterpret_cast<const std::uint8_t *>(bytes.data()), bytes.size());
    }
    return 0;
}
