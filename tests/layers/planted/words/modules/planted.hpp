int find_sight();
