// SPDX-License-Identifier: MIT
// Message types that bags of ROS 2 before Iron use without saying what they are made of. Fields and
// their order are those of common_interfaces and ros2_controllers (REP 2011 fixes the former).
#include <array>

#include "runtime/logs/message_definition.h"

namespace dyngen::runtime {
namespace {

struct KnownDefinition {
  std::string_view name, text;
};

constexpr std::string_view kControllerState1 =
    "std_msgs/Header header\nstring[] joint_names\ntrajectory_msgs/JointTrajectoryPoint desired\n"
    "trajectory_msgs/JointTrajectoryPoint actual\ntrajectory_msgs/JointTrajectoryPoint error\n";
constexpr std::string_view kControllerState2 =
    "std_msgs/Header header\nstring[] joint_names\ntrajectory_msgs/JointTrajectoryPoint reference\n"
    "trajectory_msgs/JointTrajectoryPoint feedback\ntrajectory_msgs/JointTrajectoryPoint error\n"
    "trajectory_msgs/JointTrajectoryPoint output\n";
constexpr std::string_view kControllerState3 =
    "std_msgs/Header header\nstring[] joint_names\ntrajectory_msgs/JointTrajectoryPoint reference\n"
    "trajectory_msgs/JointTrajectoryPoint feedback\ntrajectory_msgs/JointTrajectoryPoint error\n"
    "trajectory_msgs/JointTrajectoryPoint output\nstring[] multi_dof_joint_names\n"
    "trajectory_msgs/MultiDOFJointTrajectoryPoint multi_dof_reference\n"
    "trajectory_msgs/MultiDOFJointTrajectoryPoint multi_dof_feedback\n"
    "trajectory_msgs/MultiDOFJointTrajectoryPoint multi_dof_error\n"
    "trajectory_msgs/MultiDOFJointTrajectoryPoint multi_dof_output\n";

constexpr std::array<KnownDefinition, 62> kKnown = {{
    {"std_msgs/Header", "builtin_interfaces/Time stamp\nstring frame_id\n"},
    {"std_msgs/Bool", "bool data\n"},
    {"std_msgs/Int8", "int8 data\n"},
    {"std_msgs/UInt8", "uint8 data\n"},
    {"std_msgs/Int16", "int16 data\n"},
    {"std_msgs/UInt16", "uint16 data\n"},
    {"std_msgs/Int32", "int32 data\n"},
    {"std_msgs/UInt32", "uint32 data\n"},
    {"std_msgs/Int64", "int64 data\n"},
    {"std_msgs/UInt64", "uint64 data\n"},
    {"std_msgs/Float32", "float32 data\n"},
    {"std_msgs/Float64", "float64 data\n"},
    {"std_msgs/String", "string data\n"},
    {"std_msgs/MultiArrayDimension", "string label\nuint32 size\nuint32 stride\n"},
    {"std_msgs/MultiArrayLayout", "MultiArrayDimension[] dim\nuint32 data_offset\n"},
    {"std_msgs/Float32MultiArray", "MultiArrayLayout layout\nfloat32[] data\n"},
    {"std_msgs/Float64MultiArray", "MultiArrayLayout layout\nfloat64[] data\n"},
    {"std_msgs/Int16MultiArray", "MultiArrayLayout layout\nint16[] data\n"},
    {"std_msgs/Int32MultiArray", "MultiArrayLayout layout\nint32[] data\n"},
    {"std_msgs/Int64MultiArray", "MultiArrayLayout layout\nint64[] data\n"},
    {"geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z\n"},
    {"geometry_msgs/Point", "float64 x\nfloat64 y\nfloat64 z\n"},
    {"geometry_msgs/Quaternion", "float64 x\nfloat64 y\nfloat64 z\nfloat64 w\n"},
    {"geometry_msgs/Pose", "Point position\nQuaternion orientation\n"},
    {"geometry_msgs/Transform", "Vector3 translation\nQuaternion rotation\n"},
    {"geometry_msgs/Twist", "Vector3 linear\nVector3 angular\n"},
    {"geometry_msgs/Accel", "Vector3 linear\nVector3 angular\n"},
    {"geometry_msgs/Wrench", "Vector3 force\nVector3 torque\n"},
    {"geometry_msgs/Vector3Stamped", "std_msgs/Header header\nVector3 vector\n"},
    {"geometry_msgs/PointStamped", "std_msgs/Header header\nPoint point\n"},
    {"geometry_msgs/QuaternionStamped", "std_msgs/Header header\nQuaternion quaternion\n"},
    {"geometry_msgs/PoseStamped", "std_msgs/Header header\nPose pose\n"},
    {"geometry_msgs/TransformStamped",
     "std_msgs/Header header\nstring child_frame_id\nTransform transform\n"},
    {"geometry_msgs/TwistStamped", "std_msgs/Header header\nTwist twist\n"},
    {"geometry_msgs/AccelStamped", "std_msgs/Header header\nAccel accel\n"},
    {"geometry_msgs/WrenchStamped", "std_msgs/Header header\nWrench wrench\n"},
    {"geometry_msgs/Inertia",
     "float64 m\nVector3 com\nfloat64 ixx\nfloat64 ixy\nfloat64 ixz\nfloat64 iyy\nfloat64 iyz\n"
     "float64 izz\n"},
    {"geometry_msgs/InertiaStamped", "std_msgs/Header header\nInertia inertia\n"},
    {"tf2_msgs/TFMessage", "geometry_msgs/TransformStamped[] transforms\n"},
    {"sensor_msgs/JointState",
     "std_msgs/Header header\nstring[] name\nfloat64[] position\nfloat64[] velocity\n"
     "float64[] effort\n"},
    {"sensor_msgs/Imu",
     "std_msgs/Header header\ngeometry_msgs/Quaternion orientation\n"
     "float64[9] orientation_covariance\ngeometry_msgs/Vector3 angular_velocity\n"
     "float64[9] angular_velocity_covariance\ngeometry_msgs/Vector3 linear_acceleration\n"
     "float64[9] linear_acceleration_covariance\n"},
    {"sensor_msgs/Temperature", "std_msgs/Header header\nfloat64 temperature\nfloat64 variance\n"},
    {"sensor_msgs/MagneticField",
     "std_msgs/Header header\ngeometry_msgs/Vector3 magnetic_field\n"
     "float64[9] magnetic_field_covariance\n"},
    {"sensor_msgs/FluidPressure",
     "std_msgs/Header header\nfloat64 fluid_pressure\nfloat64 variance\n"},
    {"sensor_msgs/Range",
     "std_msgs/Header header\nuint8 radiation_type\nfloat32 field_of_view\nfloat32 min_range\n"
     "float32 max_range\nfloat32 range\n"},
    {"sensor_msgs/Joy", "std_msgs/Header header\nfloat32[] axes\nint32[] buttons\n"},
    {"sensor_msgs/TimeReference",
     "std_msgs/Header header\nbuiltin_interfaces/Time time_ref\nstring source\n"},
    {"sensor_msgs/MultiDOFJointState",
     "std_msgs/Header header\nstring[] joint_names\ngeometry_msgs/Transform[] transforms\n"
     "geometry_msgs/Twist[] twist\ngeometry_msgs/Wrench[] wrench\n"},
    {"trajectory_msgs/JointTrajectoryPoint",
     "float64[] positions\nfloat64[] velocities\nfloat64[] accelerations\nfloat64[] effort\n"
     "builtin_interfaces/Duration time_from_start\n"},
    {"trajectory_msgs/JointTrajectory",
     "std_msgs/Header header\nstring[] joint_names\nJointTrajectoryPoint[] points\n"},
    {"trajectory_msgs/MultiDOFJointTrajectoryPoint",
     "geometry_msgs/Transform[] transforms\ngeometry_msgs/Twist[] velocities\n"
     "geometry_msgs/Twist[] accelerations\nbuiltin_interfaces/Duration time_from_start\n"},
    {"control_msgs/InterfaceValue", "string[] interface_names\nfloat64[] values\n"},
    {"control_msgs/DynamicJointState",
     "std_msgs/Header header\nstring[] joint_names\nInterfaceValue[] interface_values\n"},
    {"control_msgs/JointTrajectoryControllerState", kControllerState1},
    {"control_msgs/JointTrajectoryControllerState", kControllerState2},
    {"control_msgs/JointTrajectoryControllerState", kControllerState3},
    {"control_msgs/JointControllerState",
     "std_msgs/Header header\nfloat64 set_point\nfloat64 process_value\nfloat64 process_value_dot\n"
     "float64 error\nfloat64 time_step\nfloat64 command\nfloat64 p\nfloat64 i\nfloat64 d\n"
     "float64 i_clamp\nbool antiwindup\n"},
    {"control_msgs/JointJog",
     "std_msgs/Header header\nstring[] joint_names\nfloat64[] displacements\nfloat64[] velocities\n"
     "float64 duration\n"},
    {"nav_msgs/Odometry",
     "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/PoseWithCovariance pose\n"
     "geometry_msgs/TwistWithCovariance twist\n"},
    {"geometry_msgs/PoseWithCovariance", "Pose pose\nfloat64[36] covariance\n"},
    {"geometry_msgs/TwistWithCovariance", "Twist twist\nfloat64[36] covariance\n"},
    {"rosgraph_msgs/Clock", "builtin_interfaces/Time clock\n"},
}};

}  // namespace

std::vector<std::string> known_definitions(std::string_view name) {
  const std::string plain = plain_type_name(name);
  std::vector<std::string> texts;
  for (const KnownDefinition& known : kKnown) {
    if (known.name == plain) texts.emplace_back(known.text);
  }
  return texts;
}

}  // namespace dyngen::runtime
