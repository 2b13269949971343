"""What all smoothers share: nodes, segments that are closed in time, and the 1-σ of the result."""
