#include <gyrostat/tests/fuzz/recorded.hpp>
#include <gyrostat/tests/fuzz/target.hpp>

namespace gyrostat::fuzz {

Target target_text() {
  return {
      .file = "rec.csv",
      .seeds =
          {"t_s,gyro_z_dps,temperature_C\n0,0.1,23\n0.1,0.2,\n0.2,-0.1,23.1\n",
           "# from a logger\nt_s;gyro_z_dps;gyro_x_dps;heading_deg;mag_valid\n"
           "0;0,1;1;10;1\n0,5;0,2;2;11;0\n1;0,3;3;12;1\n",
           "t_s gyro_z_dps acc_z_g\n0 100 1\n1 2e2 1.01\n2 NaN 0.99\n",
           "t_s,gyro_z_dps\n2023-11-14T22:13:20Z,1\n2023-11-14T22:13:21Z,2\n"
           "2023-11-14T22:13:22Z,3\n",
           "\"Time (s)\";\"Gyroscope x (rad/s)\";\"Gyroscope y (rad/s)\";\"Gyroscope z (rad/s)\"\n"
           "0,00;0,1;0,2;0,3\n0,01;0,1;0,2;0,4\n0,02;0,1;0,2;0,3\n",
           "timestamp,gyro_rad[0],gyro_rad[1],gyro_rad[2],gyro_integral_dt\n"
           "1000,0.1,0.2,0.3,4000\n11000,0.1,0.2,0.4,4000\n21000,0.1,0.2,0.3,4000\n"},
      .read = [](const std::filesystem::path& path) { read_z(path); }};
}

}  // namespace gyrostat::fuzz
