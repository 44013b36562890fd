float placeholder() { return 0.0; }
