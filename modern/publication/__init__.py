"""What is published of the project: flow charts of its programs."""
