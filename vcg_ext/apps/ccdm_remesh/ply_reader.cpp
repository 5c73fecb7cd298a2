// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>

#include "byte_order.h"
#include "polygon_soup.h"
#include "text_cursor.h"

namespace ccdm_remesh {
namespace {

enum class Type { Int8, UInt8, Int16, UInt16, Int32, UInt32, Float, Double, None };

Type TypeNamed(const std::string &name)
{
    static const std::map<std::string, Type> types = {
        {"char", Type::Int8},   {"int8", Type::Int8},     {"uchar", Type::UInt8},   {"uint8", Type::UInt8},
        {"short", Type::Int16}, {"int16", Type::Int16},   {"ushort", Type::UInt16}, {"uint16", Type::UInt16},
        {"int", Type::Int32},   {"int32", Type::Int32},   {"uint", Type::UInt32},   {"uint32", Type::UInt32},
        {"float", Type::Float}, {"float32", Type::Float}, {"double", Type::Double}, {"float64", Type::Double}};
    const auto at = types.find(name);
    return at == types.end() ? Type::None : at->second;
}

std::size_t SizeOf(Type type)
{
    constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8, 0};
    return sizes[static_cast<int>(type)];
}

// What a property is read into.
enum class Use { Nothing, X, Y, Z, Quality, Polygon, Strips };

struct Property {
    std::string name;
    Type type = Type::None;
    Type count = Type::None; // of a list's length; None if it is no list
    Use use = Use::Nothing;
};

struct Element {
    std::string name;
    std::uint64_t count = 0;
    std::vector<Property> property;

    bool Has(Use use) const
    {
        return std::any_of(property.begin(), property.end(), [use](const Property &p) { return p.use == use; });
    }
};

// The values of the body one after the other, in any of the three formats.
class Body
{
public:
    enum class Format { Text, LittleEndian, BigEndian };

    Body(const std::string &content, std::size_t begin, Format format)
        : _at(content.c_str() + begin), _end(content.c_str() + content.size()), _format(format), _words(_at, _end)
    {
    }

    std::size_t Left() const { return static_cast<std::size_t>(_end - (_format == Format::Text ? _words.At() : _at)); }
    /// Of a value, at least; in text one takes a digit and a separator.
    std::size_t LeastSize(Type type) const { return _format == Format::Text ? 2 : SizeOf(type); }

    /// False at the end, and where there is no number.
    bool Next(Type type, double &x)
    {
        if (_format == Format::Text)
            return _words.Number(x);
        if (Left() < SizeOf(type))
            return false;
        x = Value(type, _format == Format::BigEndian);
        _at += SizeOf(type);
        return true;
    }

private:
    const char *_at, *_end;
    Format _format;
    TextCursor _words;

    double Value(Type type, bool big) const
    {
        switch (type) {
        case Type::Int8:
            return FromBytes<std::int8_t>(_at, big);
        case Type::UInt8:
            return FromBytes<std::uint8_t>(_at, big);
        case Type::Int16:
            return FromBytes<std::int16_t>(_at, big);
        case Type::UInt16:
            return FromBytes<std::uint16_t>(_at, big);
        case Type::Int32:
            return FromBytes<std::int32_t>(_at, big);
        case Type::UInt32:
            return FromBytes<std::uint32_t>(_at, big);
        case Type::Float:
            return FromBytes<float>(_at, big);
        case Type::Double:
            return FromBytes<double>(_at, big);
        case Type::None:
            break;
        }
        return 0;
    }
};

// A number that is none of a vertex stands for what cannot be an index.
int ToIndex(double x)
{
    return x >= 0 && x <= std::numeric_limits<int>::max() && std::floor(x) == x ? static_cast<int>(x) : -1;
}

class PlyReader
{
public:
    PlyReader(const std::string &content, PolygonSoup &soup) : _content(content), _soup(soup) {}

    std::string Run()
    {
        std::size_t begin = 0;
        std::string fault = ReadHeader(begin);
        if (!fault.empty())
            return fault;
        Body body(_content, begin, _format);
        for (const Element &e : _elements) {
            fault = CheckElement(e, body);
            if (!fault.empty())
                return fault;
            for (std::uint64_t k = 0; k < e.count; ++k)
                if (!ReadElement(e, body))
                    return "the file ends, or holds what is no number, at " + e.name + " " + std::to_string(k);
        }
        const auto isVertex = [](const Element &e) { return e.name == "vertex"; };
        return std::any_of(_elements.begin(), _elements.end(), isVertex) ? "" : "it has no vertices";
    }

private:
    const std::string &_content;
    PolygonSoup &_soup;
    Body::Format _format = Body::Format::Text;
    std::vector<Element> _elements;
    std::vector<int> _list;

    std::string ReadHeader(std::size_t &begin)
    {
        TextLines lines(_content);
        std::string line;
        if (!lines.Next(line) || line != "ply")
            return "it does not start with 'ply'";
        bool format = false;
        while (lines.Next(line)) {
            TextCursor words(line.c_str(), line.c_str() + line.size());
            const std::string word = words.Word();
            std::string fault;
            if (word == "end_header") {
                begin = lines.At();
                return format ? "" : "its header names no format";
            }
            if (word == "format") {
                format = true;
                fault = SetFormat(words.Word());
            } else if (word == "element") {
                fault = AddElement(words);
            } else if (word == "property") {
                fault = AddProperty(words, line);
            }
            if (!fault.empty())
                return fault;
        }
        return "its header has no end";
    }

    std::string SetFormat(const std::string &name)
    {
        if (name == "ascii")
            _format = Body::Format::Text;
        else if (name == "binary_little_endian")
            _format = Body::Format::LittleEndian;
        else if (name == "binary_big_endian")
            _format = Body::Format::BigEndian;
        else
            return "its format '" + name + "' is not known";
        return "";
    }

    std::string AddElement(TextCursor &words)
    {
        Element e;
        e.name = words.Word();
        double count = -1;
        if (!words.Number(count) || ToIndex(count) < 0)
            return "the header gives a wrong number of " + e.name + " elements";
        e.count = static_cast<std::uint64_t>(count);
        _elements.push_back(e);
        return "";
    }

    std::string AddProperty(TextCursor &words, const std::string &line)
    {
        Property p;
        std::string type = words.Word();
        const bool list = type == "list";
        if (list) {
            p.count = TypeNamed(words.Word());
            type = words.Word();
        }
        p.type = TypeNamed(type);
        p.name = words.Word();
        if (_elements.empty() || p.type == Type::None || (list && p.count == Type::None))
            return "a property of the header cannot be understood: " + line;
        Element &e = _elements.back();
        p.use = UseOf(e.name, p.name, list);
        if (e.Has(p.use) && p.use != Use::Nothing)
            p.use = Use::Nothing;
        e.property.push_back(p);
        return "";
    }

    static Use UseOf(const std::string &element, const std::string &name, bool list)
    {
        static const std::map<std::string, Use> scalars = {
            {"x", Use::X}, {"y", Use::Y}, {"z", Use::Z}, {"quality", Use::Quality}, {"confidence", Use::Quality}};
        const bool indices = list && (name == "vertex_indices" || name == "vertex_index");
        if (element == "face" && indices)
            return Use::Polygon;
        if (element == "tristrips" && indices)
            return Use::Strips;
        const auto at = scalars.find(name);
        return element == "vertex" && !list && at != scalars.end() ? at->second : Use::Nothing;
    }

    std::string CheckElement(const Element &e, const Body &body)
    {
        std::size_t least = 0;
        for (const Property &p : e.property)
            least += body.LeastSize(p.count == Type::None ? p.type : p.count);
        // The last value of a text may end with the file.
        if (e.count > 0 && least > (body.Left() + 1) / e.count)
            return "the header promises more " + e.name + " elements than the file holds";
        if (least == 0 && e.count > 0)
            return "the " + e.name + " elements have no properties";
        if (e.name == "vertex") {
            if (!e.Has(Use::X) || !e.Has(Use::Y) || !e.Has(Use::Z))
                return "the vertices have no x, y and z";
            if (!_soup.point.empty())
                return "it has two lists of vertices";
            _soup.point.reserve(e.count);
        }
        if (e.name == "face" && e.count > 0 && !e.Has(Use::Polygon))
            return "the faces have no vertex indices";
        return "";
    }

    bool ReadElement(const Element &e, Body &body)
    {
        vcg::Point3d point(0, 0, 0);
        for (const Property &p : e.property) {
            if (p.count != Type::None) {
                if (!ReadList(p, body))
                    return false;
                continue;
            }
            double x = 0;
            if (!body.Next(p.type, x))
                return false;
            if (p.use == Use::X || p.use == Use::Y || p.use == Use::Z)
                point[static_cast<int>(p.use) - static_cast<int>(Use::X)] = x;
            else if (p.use == Use::Quality)
                _soup.quality.push_back(x);
        }
        if (e.name == "vertex")
            _soup.point.push_back(point);
        return true;
    }

    bool ReadList(const Property &p, Body &body)
    {
        double count = 0;
        if (!body.Next(p.count, count) || ToIndex(count) < 0)
            return false;
        _list.clear();
        for (double k = 0; k < count; ++k) {
            double x = 0;
            if (!body.Next(p.type, x))
                return false;
            // Strips are divided by -1, which no index is.
            if (p.use != Use::Nothing)
                _list.push_back(ToIndex(x));
        }
        if (p.use == Use::Polygon && _list.size() > 2) { // points and edges are no part of the surface
            _soup.corner.insert(_soup.corner.end(), _list.begin(), _list.end());
            _soup.ClosePolygon();
        } else if (p.use == Use::Strips) {
            AddStrips();
        }
        return true;
    }

    // Every second triangle of a strip runs the other way around.
    void AddStrips()
    {
        std::size_t first = 0;
        for (std::size_t k = 0; k < _list.size(); ++k) {
            if (_list[k] < 0)
                first = k + 1;
            if (k < first + 2)
                continue;
            const bool turned = (k - first) % 2 != 0;
            for (const int v : {_list[k - 2], _list[turned ? k : k - 1], _list[turned ? k - 1 : k]})
                _soup.corner.push_back(v);
            _soup.ClosePolygon();
        }
    }
};

} // namespace

std::string ReadPly(const std::string &content, PolygonSoup &soup)
{
    return PlyReader(content, soup).Run();
}

} // namespace ccdm_remesh
