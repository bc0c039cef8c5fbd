<?xml version="1.0"?>
<robot name="arm">
  <link name="base"/>
</robot>
