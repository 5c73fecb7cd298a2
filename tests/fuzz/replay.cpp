// SPDX-License-Identifier: GPL-3.0-or-later
// Runs a target on files, without a fuzzer: replay remesher|readers FILE...
#include <cstring>
#include <fstream>
#include <iterator>
#include <vector>

#include "fuzz/targets.h"

int main(int argc, char **argv)
{
    const bool remesher = argc > 2 && std::strcmp(argv[1], "remesher") == 0;
    if (argc < 3 || (!remesher && std::strcmp(argv[1], "readers") != 0)) {
        std::fprintf(stderr, "usage: replay remesher|readers FILE...\n");
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
        (remesher ? fuzz::RunRemesher : fuzz::RunReaders)(reinterpret_cast<const std::uint8_t *>(bytes.data()),
                                                          bytes.size());
    }
    return 0;
}
