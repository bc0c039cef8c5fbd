number_link 3
joints 1st el-bow arm
gz 9.81
stop
