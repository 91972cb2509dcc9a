#pragma once

#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

namespace stockwork
{
/// Writes one JSON document, member by member, with true numbers and true text escapes.
///
///     JsonWriter json(out);
///     json.begin_object();
///     json.member("steps", 12);
///     json.begin_object("final");
///     ...
///     json.end_object();
///     json.end_object();
class JsonWriter
{
public:
  explicit JsonWriter(std::ostream &out);

  /// The document itself or an element of an array.
  void begin_object();
  void begin_object(const std::string &name);
  void end_object();

  void begin_array(const std::string &name);
  void end_array();

  /// @throws OutputError, naming the member, if the value is infinite or undefined: JSON has no
  /// such numbers, and whoever reads the file should not meet one.
  void member(const std::string &name, double value);
  void member(const std::string &name, std::uint64_t value);
  void member(const std::string &name, unsigned int value);
  void member(const std::string &name, int value);
  void member(const std::string &name, bool value);
  void member(const std::string &name, const std::string &value);
  void member(const std::string &name, const char *value);

  void element(const std::string &value);
  void element(double value);

private:
  void next();
  void name(const std::string &name);
  void number(const std::string &what, double value);
  void begin(char bracket);
  void end(char bracket);

  std::ostream &out;
  std::vector<bool> is_first; ///< by level: nothing has been written there yet
};
} // namespace stockwork
