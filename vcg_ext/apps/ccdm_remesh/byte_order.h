// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CCDM_REMESH_BYTE_ORDER_H
#define CCDM_REMESH_BYTE_ORDER_H

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

namespace ccdm_remesh {

/// A number of type T from its bytes, the last one first if they are in `bigEndian` order.
template <class T>
T FromBytes(const char *at, bool bigEndian)
{
    const std::uint16_t one = 1;
    char first = 0;
    std::memcpy(&first, &one, 1);
    char bytes[sizeof(T)];
    for (std::size_t k = 0; k < sizeof(T); ++k)
        bytes[k] = at[(first == 1) == bigEndian ? sizeof(T) - 1 - k : k];
    T x;
    std::memcpy(&x, bytes, sizeof(T));
    return x;
}

template <class T>
T FromLittleEndian(const char *at)
{
    return FromBytes<T>(at, false);
}

template <class T>
void AppendLittleEndian(std::string &bytes, T x)
{
    char raw[sizeof(T)];
    std::memcpy(raw, &x, sizeof(T));
    const T swapped = FromLittleEndian<T>(raw);
    std::memcpy(raw, &swapped, sizeof(T));
    bytes.append(raw, sizeof(T));
}

} // namespace ccdm_remesh

#endif
