// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CCDM_TESTS_FUZZ_BYTES_H
#define CCDM_TESTS_FUZZ_BYTES_H

#include <cstddef>
#include <cstdint>

namespace fuzz {

/// What a fuzzer gives, read as small numbers; zeros follow its end.
class Bytes
{
public:
    Bytes(const std::uint8_t *data, std::size_t size) : _data(data), _size(size) {}

    bool Empty() const { return _at >= _size; }
    int Next() { return Empty() ? 0 : _data[_at++]; }
    /// In [0, n).
    int Below(int n) { return Next() % n; }
    /// In [low, high].
    int Between(int low, int high) { return low + Below(high - low + 1); }
    bool Flag() { return (Next() & 1) != 0; }

private:
    const std::uint8_t *_data;
    std::size_t _size, _at = 0;
};

} // namespace fuzz

#endif
