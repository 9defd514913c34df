#pragma once

#include <gyrostat/recordings/binary/cursor.hpp>
#include <gyrostat/recordings/binary/imu_log.hpp>
#include <gyrostat/recordings/binary/unpack.hpp>
#include <gyrostat/recordings/binary/whole_file.hpp>
#include <gyrostat/recordings/format_type.hpp>

namespace gyrostat {

/// The table of a log of ROS messages that begins with `magic`. A Reader is made of an Unpacker,
/// takes the records behind the magic by `read(Cursor, in_chunk)` and leaves their messages in
/// `log`. A log that ends within a record has what came before. Throws InputError with the file's
/// place.
template <class Reader>
ColumnTable read_message_log(const FormatSource& source, std::string_view magic) {
  const WholeFile file(source);
  Reader reader{Unpacker(source.place)};
  try {
    Cursor records(file.bytes());
    records.bytes(magic.size());
    reader.read(records, false);
  } catch (const CutOff&) {
    reader.log.cut_off();
  }
  return std::move(reader.log).table(source.topic, source.place, "a topic of sensor_msgs/Imu");
}

}  // namespace gyrostat
