// SPDX-License-Identifier: BSD-3-Clause

/** Values by key; who follows a key hears of that key alone, after the value has changed. */
export class Store<Values extends object> {
  private readonly followers = new Map<keyof Values, Set<() => void>>();

  constructor(private readonly values: Values) {}

  get<Key extends keyof Values>(key: Key): Values[Key] {
    return this.values[key];
  }

  set<Key extends keyof Values>(key: Key, value: Values[Key]): void {
    if (Object.is(this.values[key], value)) return;
    this.values[key] = value;
    for (const follower of [...(this.followers.get(key) ?? [])]) follower();
  }

  /** Calls `follower` once now, and whenever one of the keys has changed. */
  follow(keys: readonly (keyof Values)[], follower: () => void): void {
    for (const key of keys) {
      let set = this.followers.get(key);
      if (!set) this.followers.set(key, (set = new Set()));
      set.add(follower);
    }
    follower();
  }
}
