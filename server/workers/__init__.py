"""What runs inside the child processes: the learner and the robot."""
