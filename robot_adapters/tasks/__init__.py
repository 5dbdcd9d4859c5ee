"""What each task says of its state, skills, goal and teacher. numpy only."""
