// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CCDM_REMESH_TEXT_CURSOR_H
#define CCDM_REMESH_TEXT_CURSOR_H

#include <cerrno>
#include <climits>
#include <cstdlib>
#include <string>

namespace ccdm_remesh {

/// Reads words and numbers of a text that ends with a zero byte.
class TextCursor
{
public:
    TextCursor(const char *begin, const char *end) : _at(begin), _end(end) {}

    const char *At() const { return _at; }
    bool AtEnd()
    {
        SkipBlanks();
        return _at == _end;
    }

    /// The next run of other than blanks; empty at the end.
    std::string Word()
    {
        SkipBlanks();
        const char *first = _at;
        while (_at != _end && !IsBlank(*_at))
            ++_at;
        return std::string(first, _at);
    }

    /// The next word as a number; false if it is none.
    bool Number(double &x)
    {
        if (AtEnd())
            return false;
        char *end = nullptr;
        x = std::strtod(_at, &end);
        return Accept(end);
    }

    /// The next word as an index; false if it is none or too large.
    bool Integer(int &k)
    {
        if (AtEnd())
            return false;
        char *end = nullptr;
        errno = 0;
        const long value = std::strtol(_at, &end, 10);
        if (errno == ERANGE || value < INT_MIN || value > INT_MAX)
            return false;
        k = static_cast<int>(value);
        return Accept(end);
    }

private:
    const char *_at, *_end;

    static bool IsBlank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f'; }

    void SkipBlanks()
    {
        while (_at != _end && IsBlank(*_at))
            ++_at;
    }

    bool Accept(const char *end)
    {
        if (end == _at || end > _end || (end != _end && !IsBlank(*end)))
            return false;
        _at = end;
        return true;
    }
};

/// The lines of a text, without their ends.
class TextLines
{
public:
    explicit TextLines(const std::string &text) : _text(text) {}

    /// The next line; false at the end.
    bool Next(std::string &line)
    {
        if (_at >= _text.size())
            return false;
        std::size_t end = _text.find('\n', _at);
        if (end == std::string::npos)
            end = _text.size();
        line.assign(_text, _at, end - _at);
        if (!line.empty() && line.back() == '\r')
            line.pop_back();
        _at = end + 1;
        ++number;
        return true;
    }

    /// Place behind the last line, at most the text's size.
    std::size_t At() const { return _at < _text.size() ? _at : _text.size(); }

    long long number = 0; ///< of the last line, from 1

private:
    const std::string &_text;
    std::size_t _at = 0;
};

} // namespace ccdm_remesh

#endif
