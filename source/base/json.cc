#include "stockwork/base/json.h"

#include "stockwork/base/error.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace stockwork
{
namespace
{
std::string quoted(const std::string &text)
{
  std::string result = "\"";
  for (const char c : text)
    if (c == '"' || c == '\\')
      result += std::string("\\") + c;
    else if (c == '\n')
      result += "\\n";
    else if (c == '\t')
      result += "\\t";
    else if (static_cast<unsigned char>(c) < 0x20)
    {
      char code[8];
      std::snprintf(code, sizeof(code), "\\u%04x", static_cast<unsigned int>(c));
      result += code;
    }
    else
      result += c;
  return result + "\"";
}
} // namespace

JsonWriter::JsonWriter(std::ostream &out)
  : out(out)
{
}

void JsonWriter::next()
{
  if (is_first.empty())
    return;
  out << (is_first.back() ? "\n" : ",\n") << std::string(2 * is_first.size(), ' ');
  is_first.back() = false;
}

void JsonWriter::name(const std::string &name)
{
  next();
  out << quoted(name) << ": ";
}

void JsonWriter::begin(const char bracket)
{
  out << bracket;
  is_first.push_back(true);
}

void JsonWriter::end(const char bracket)
{
  const bool empty = is_first.back();
  is_first.pop_back();
  if (!empty)
    out << '\n' << std::string(2 * is_first.size(), ' ');
  out << bracket;
  if (is_first.empty())
    out << '\n';
}

void JsonWriter::begin_object()
{
  next();
  begin('{');
}

void JsonWriter::begin_object(const std::string &member)
{
  name(member);
  begin('{');
}

void JsonWriter::end_object()
{
  end('}');
}

void JsonWriter::begin_array(const std::string &member)
{
  name(member);
  begin('[');
}

void JsonWriter::end_array()
{
  end(']');
}

void JsonWriter::number(const std::string &what, const double value)
{
  if (!std::isfinite(value))
    throw OutputError("'" + what + "' is " + std::to_string(value) + " and cannot be written");
  char text[32];
  for (int digits = 15; digits <= 17; ++digits)
  {
    std::snprintf(text, sizeof(text), "%.*g", digits, value);
    if (std::strtod(text, nullptr) == value)
      break;
  }
  out << text;
}

void JsonWriter::member(const std::string &member, const double value)
{
  name(member);
  number(member, value);
}

void JsonWriter::member(const std::string &member, const std::uint64_t value)
{
  name(member);
  out << value;
}

void JsonWriter::member(const std::string &member, const unsigned int value)
{
  name(member);
  out << value;
}

void JsonWriter::member(const std::string &member, const int value)
{
  name(member);
  out << value;
}

void JsonWriter::member(const std::string &member, const bool value)
{
  name(member);
  out << (value ? "true" : "false");
}

void JsonWriter::member(const std::string &member, const std::string &value)
{
  name(member);
  out << quoted(value);
}

void JsonWriter::member(const std::string &name, const char *value)
{
  member(name, std::string(value));
}

void JsonWriter::element(const std::string &value)
{
  next();
  out << quoted(value);
}

void JsonWriter::element(const double value)
{
  next();
  number("element of an array", value);
}
} // namespace stockwork
